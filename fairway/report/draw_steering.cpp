#include "fairway/report/draw_steering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/report/chart_lines.hpp"
#include "fairway/report/flight_path.hpp"
#include "fairway/report/mission_marks.hpp"
#include "fairway/report/thinned_path.hpp"

namespace fairway {
namespace {

constexpr double margin_pt = 8.0;
constexpr double title_room_pt = 20.0;
constexpr double gap_pt = 16.0;
constexpr double arrow_pt = 20.0;
constexpr double chart_width_pt = 220.0;
constexpr double chart_height_pt = 130.0;
constexpr double thinnest_aspect = 0.3;  // of the map's sides

const Pen path_pen{series_color(0), 1.8, {}};
const Pen compared_pen{{60, 60, 60}, 1.1, {4.5, 2.5}};
const Color start_color = palette::ink;
const Color goal_color{0, 110, 80};
const std::vector<double> circle_dash{2.5, 2.0};

struct Window {
  Vec2 low{};
  Vec2 high{};
  void hold(Vec2 p, double room_m) {
    low = {std::min(low.x, p.x - room_m), std::min(low.y, p.y - room_m)};
    high = {std::max(high.x, p.x + room_m), std::max(high.y, p.y + room_m)};
  }
};

std::array<Vec2, 2> circle_centers(const State& s, double radius_m) {
  const Vec2 left = radius_m * left_of(s.heading.unit());
  return {s.position_m + left, s.position_m - left};
}

void hold_path(Window& window, const SteeredPath& path, double radius_m) {
  for (const FlightSegment& piece : path.segments) {
    const double step_m = piece.curvature_per_m == 0.0 ? piece.length_m : 0.1 * radius_m;
    const double steps = std::clamp(std::ceil(piece.length_m / step_m), 1.0, 1000.0);
    for (double k = 0.0; k <= steps; k += 1.0) {
      window.hold(state_at(piece, piece.length_m * k / steps).position_m, 0.1 * radius_m);
    }
  }
}

/// Bounds of everything drawn, with a small margin.
Window window_of(const SteeringPicture& p) {
  Window window{p.start.position_m, p.start.position_m};
  const auto hold_circles = [&](const State& s) {
    for (const Vec2 c : circle_centers(s, p.turn_radius_m)) window.hold(c, 1.1 * p.turn_radius_m);
  };
  hold_circles(p.start);
  for (const State& goal : p.goals) hold_circles(goal);
  hold_path(window, p.path, p.turn_radius_m);
  if (p.compared) hold_path(window, *p.compared, p.turn_radius_m);
  const Vec2 size = window.high - window.low;
  // Not too thin for a page, nor for the precision of its numbers.
  const double farthest = std::max(norm(window.low), norm(window.high));
  const double least =
      std::max({thinnest_aspect * std::max(size.x, size.y), 1e-9 * farthest, 1e-290});
  const Vec2 room{0.5 * std::max(0.0, least - size.x), 0.5 * std::max(0.0, least - size.y)};
  return {window.low - room, window.high + room};
}

PlotFrame map_frame(const SteeringPicture& p) {
  const Window window = window_of(p);
  const Vec2 size = window.high - window.low;
  const double scale = p.map_pt / std::max(size.x, size.y);
  const auto ticks = [](double across, double along) { return across >= 0.5 * along ? 6 : 3; };
  PlotFrame frame;
  frame.x = {window.low.x, window.high.x, "x (m)", ticks(size.x, size.y)};
  frame.y = {window.low.y, window.high.y, "y (m)", ticks(size.y, size.x)};
  frame.rect.width = scale * size.x;
  frame.rect.height = scale * size.y;
  return frame;
}

void draw_circles(Canvas& canvas, const PlotFrame& frame, const State& s, double radius_m,
                  const Color& color) {
  const double radius_pt = radius_m * frame.rect.width / (frame.x.high - frame.x.low);
  for (const Vec2 center : circle_centers(s, radius_m)) {
    canvas.stroke(DrawingPath::circle(frame.to_page(center), radius_pt), {color, 0.7, circle_dash});
  }
}

void draw_arrow(Canvas& canvas, Vec2 at, Vec2 along, const Color& color) {
  canvas.fill(DrawingPath::circle(at, 2.4), color);
  canvas.stroke(DrawingPath::polyline({at, at + (arrow_pt - 5.0) * along}), {color, 1.6, {}});
  DrawingPath head;
  add_arrow_head(head, at + arrow_pt * along, along, 7.5);
  canvas.fill(head, color);
}

Vec2 page_unit(const Heading& heading) { return {heading.unit().x, -heading.unit().y}; }

void draw_pose(Canvas& canvas, const PlotFrame& frame, const State& s, const Color& color) {
  draw_arrow(canvas, frame.to_page(s.position_m), page_unit(s.heading), color);
}

/// To the side of its waypoint, since paths come and go along its heading; on the emptier side.
void draw_number(Canvas& canvas, const PlotFrame& frame, const SteeringPicture& p, std::size_t k) {
  const Vec2 at = frame.to_page(p.goals[k].position_m);
  const Vec2 across = left_of(page_unit(p.goals[k].heading));
  const auto room_pt = [&](Vec2 place) {
    double nearest = norm(place - frame.to_page(p.start.position_m));
    for (std::size_t i = 0; i < p.goals.size(); ++i) {
      if (i != k) nearest = std::min(nearest, norm(place - frame.to_page(p.goals[i].position_m)));
    }
    return nearest;
  };
  const Vec2 right = at + 10.0 * across;
  const Vec2 left = at - 10.0 * across;
  const Vec2 place = room_pt(right) >= std::min(room_pt(left), 40.0) ? right : left;
  canvas.fill(DrawingPath::circle(place, 6.0), {255, 255, 255, 0.85});
  canvas.text(fmt::format("{}", k + 1), {place.x, place.y + 3.0},
              {.size_pt = 8.5, .anchor = Anchor::middle, .bold = true, .color = goal_color});
}

/// An arrow head half-way along each leg would hide short legs, so there is one for the whole path.
void draw_direction(Canvas& canvas, const PlotFrame& frame, const SteeredPath& path) {
  double left_m = 0.0;
  for (const FlightSegment& piece : path.segments) left_m += 0.5 * piece.length_m;
  for (const FlightSegment& piece : path.segments) {
    if (left_m > piece.length_m) {
      left_m -= piece.length_m;
      continue;
    }
    const State middle = state_at(piece, left_m);
    const Vec2 along = page_unit(middle.heading);
    DrawingPath head;
    add_arrow_head(head, frame.to_page(middle.position_m) + 4.0 * along, along, 8.0);
    canvas.fill(head, path_pen.color);
    return;
  }
}

void draw_map(Canvas& canvas, const PlotFrame& frame, const SteeringPicture& p) {
  draw_axes(canvas, frame, true);
  {
    const auto layer = canvas.layer("circles", frame.rect);
    draw_circles(canvas, frame, p.start, p.turn_radius_m, palette::faint_ink);
    for (const State& goal : p.goals)
      draw_circles(canvas, frame, goal, p.turn_radius_m, goal_color);
  }
  {
    const auto layer = canvas.layer("path", frame.rect);
    canvas.stroke(thinned(segments_path(p.path.segments, frame), unseen_pt), path_pen);
    draw_direction(canvas, frame, p.path);
  }
  if (p.compared) {
    const auto layer = canvas.layer("compared", frame.rect);
    canvas.stroke(thinned(segments_path(p.compared->segments, frame), unseen_pt), compared_pen);
  }
  const auto layer = canvas.layer("poses", frame.rect);
  for (std::size_t k = 0; k < p.goals.size() && p.goals.size() > 1; ++k) {
    draw_number(canvas, frame, p, k);
  }
  for (const State& goal : p.goals) draw_pose(canvas, frame, goal, goal_color);
  draw_pose(canvas, frame, p.start, start_color);
}

LegendEntry arrow_entry(std::string name, const Color& color) {
  return {std::move(name), [color](Canvas& canvas, const Rect& box) {
            draw_arrow(canvas, {box.x + 2.0, box.y + 0.5 * box.height}, {1.0, 0.0}, color);
          }};
}

std::vector<LegendEntry> map_entries(const SteeringPicture& p) {
  std::vector<LegendEntry> entries{
      arrow_entry("start", start_color),
      arrow_entry(p.goals.size() > 1 ? "waypoints" : "goal", goal_color),
      line_entry(p.path.name, path_pen)};
  if (p.compared) entries.push_back(line_entry(p.compared->name, compared_pen));
  entries.push_back(line_entry(fmt::format("circles of least radius, {:g} m", p.turn_radius_m),
                               {goal_color, 0.7, circle_dash}));
  return entries;
}

double height_of(const std::vector<LegendEntry>& entries) {
  return legend_row_pt * static_cast<double>(entries.size());
}

}  // namespace

Picture draw_steering(const SteeringPicture& p) {
  require(p.turn_radius_m > 0.0, "a radius is positive");
  require(p.map_pt >= 100.0 && p.map_pt <= 2000.0, "map_pt is in 100..2000");
  require(p.pixels_per_pt >= 0.5 && p.pixels_per_pt <= 8.0, "pixels_per_pt is in 0.5..8");
  const double top = margin_pt + (p.title.empty() ? 0.0 : title_room_pt);
  PlotFrame map = map_frame(p);
  map.rect.x = margin_pt + y_axis_room_pt(map.y);
  map.rect.y = top;

  const std::vector<LegendEntry> entries = map_entries(p);
  const double side_x = map.rect.right() + gap_pt;
  PlotFrame chart = chart_frame(
      p.values, {.x_label = "driven (m)", .y_label = p.value_label, .y_from_zero = true});
  const std::vector<LegendEntry> values = chart_entries(p.values);
  chart.x.ticks_wanted = 5;
  chart.y.ticks_wanted = 5;
  chart.rect = {side_x + y_axis_room_pt(chart.y), top + height_of(entries) + gap_pt, chart_width_pt,
                chart_height_pt};
  double right = side_x + legend_width_pt(entries);
  double bottom = std::max(map.rect.bottom() + x_axis_room_pt, top + height_of(entries));
  if (!p.values.empty()) {
    right = std::max(right, chart.rect.right() + 6.0);
    bottom = std::max(bottom, chart.rect.bottom() + x_axis_room_pt + 4.0 + height_of(values));
  }
  const double title_width = text_width_pt(p.title, {.size_pt = 11.0, .bold = true});
  Canvas canvas(std::max(right, map.rect.x + title_width) + margin_pt, bottom + margin_pt,
                p.pixels_per_pt, p.title);

  draw_map(canvas, map, p);
  draw_legend(canvas, {side_x, top}, entries);
  if (!p.values.empty()) {
    draw_chart_lines(canvas, chart, p.values);
    draw_legend(canvas, {chart.rect.x, chart.rect.bottom() + x_axis_room_pt + 4.0}, values);
  }
  if (!p.title.empty()) {
    const auto layer = canvas.layer("title");
    canvas.text(p.title, {map.rect.x, margin_pt + 11.0}, {.size_pt = 11.0, .bold = true});
  }
  return canvas.finish();
}

}  // namespace fairway
