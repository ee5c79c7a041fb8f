#include "fairway/report/mission_marks.hpp"

#include <cmath>

namespace fairway {
namespace {

const Pen path_pen{{170, 51, 119}, 1.6, {6.0, 2.0, 1.5, 2.0}};
const Pen goal_pen{{0, 90, 65}, 1.6, {}};
constexpr double between_heads_pt = 90.0;

DrawingPath cross_at(Vec2 center, double arm_pt) {
  DrawingPath path;
  path.move_to({center.x - arm_pt, center.y}).line_to({center.x + arm_pt, center.y});
  path.move_to({center.x, center.y - arm_pt}).line_to({center.x, center.y + arm_pt});
  return path;
}

void draw_goal(Canvas& canvas, const PlotFrame& frame, const GoalMission& mission) {
  const Vec2 at = frame.to_page(mission.goal_m);
  canvas.stroke(cross_at(at, 5.0), goal_pen);
  if (!mission.goal_heading_rad) return;
  const double h = *mission.goal_heading_rad;
  const Vec2 along{std::cos(h), -std::sin(h)};
  canvas.stroke(DrawingPath::polyline({at, at + 18.0 * along}), goal_pen);
  DrawingPath head;
  add_arrow_head(head, at + 22.0 * along, along, 7.0);
  canvas.fill(head, goal_pen.color);
}

void draw_path(Canvas& canvas, const PlotFrame& frame, const PathMission& mission) {
  std::vector<Vec2> points;
  for (const Vec2 vertex : mission.vertices_m) points.push_back(frame.to_page(vertex));
  if (mission.closed && !points.empty()) points.push_back(points.front());
  canvas.stroke(DrawingPath::polyline(points), path_pen);
  DrawingPath heads;
  double until_head = 0.5 * between_heads_pt;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double length = norm(points[i] - points[i - 1]);
    if (!(length > 0.0)) continue;
    const Vec2 along = 1.0 / length * (points[i] - points[i - 1]);
    double at = until_head;
    for (; at <= length; at += between_heads_pt)
      add_arrow_head(heads, points[i - 1] + at * along, along, 8.0);
    until_head = at - length;
  }
  canvas.fill(heads, path_pen.color);
}

}  // namespace

void add_arrow_head(DrawingPath& path, Vec2 tip, Vec2 along, double length_pt) {
  const Vec2 base = tip - length_pt * along;
  const Vec2 side = 0.35 * length_pt * left_of(along);
  path.move_to(tip).line_to(base + side).line_to(base - side).close();
}

void draw_mission(Canvas& canvas, const PlotFrame& frame, const Mission& mission) {
  const auto layer = canvas.layer("mission", frame.rect);
  if (const auto* goal = std::get_if<GoalMission>(&mission)) draw_goal(canvas, frame, *goal);
  if (const auto* path = std::get_if<PathMission>(&mission)) draw_path(canvas, frame, *path);
}

LegendEntry mission_entry(const Mission& mission) {
  if (std::holds_alternative<PathMission>(mission)) return line_entry("path to follow", path_pen);
  return {
      "goal point", [](Canvas& canvas, const Rect& box) {
        canvas.stroke(cross_at({box.x + 0.5 * box.width, box.y + 0.5 * box.height}, 4.0), goal_pen);
      }};
}

}  // namespace fairway
