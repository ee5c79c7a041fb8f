#include "fairway/report/draw_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/report/map_page.hpp"
#include "fairway/report/mission_marks.hpp"
#include "fairway/report/streamlines.hpp"

namespace fairway {
namespace {

const Pen stream_pen{palette::ink, 0.7, {}};
const Pen arrow_pen{palette::ink, 0.7, {}};
constexpr double stream_head_pt = 5.0;
constexpr double between_stream_heads_pt = 70.0;

/// Vertices that change the line by less than a tenth of a point only add bytes.
std::vector<Vec2> thinned(const std::vector<Vec2>& line) {
  constexpr double tolerance_pt = 0.1;
  constexpr std::size_t longest_look_back = 64;
  std::vector<Vec2> kept{line.front()};
  std::size_t anchor = 0;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Vec2 chord = line[i + 1] - line[anchor];
    const double length = norm(chord);
    bool needed = i - anchor >= longest_look_back;
    for (std::size_t k = anchor + 1; k <= i && !needed; ++k)
      needed = std::abs(cross(chord, line[k] - line[anchor])) > tolerance_pt * length;
    if (!needed) continue;
    kept.push_back(line[i]);
    anchor = i;
  }
  kept.push_back(line.back());
  return kept;
}

void add_heads_along(DrawingPath& heads, const std::vector<Vec2>& line) {
  double total = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) total += norm(line[i] - line[i - 1]);
  const double count = std::max(1.0, std::floor(total / between_stream_heads_pt));
  double passed = 0.0;
  double next = 0.5 * total / count;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double length = norm(line[i] - line[i - 1]);
    passed += length;
    if (passed < next || !(length > 0.0)) continue;
    const Vec2 along = 1.0 / length * (line[i] - line[i - 1]);
    add_arrow_head(heads, line[i] + 0.5 * stream_head_pt * along, along, stream_head_pt);
    next += total / count;
  }
}

void draw_streamlines(MapPage& page, const Plan& plan, int across) {
  const auto layer = page.canvas().layer("streamlines", page.frame().rect);
  const double longer_m = std::max(plan.grid.width_m(), plan.grid.height_m());
  if (!(longer_m > 0.0)) return;
  DrawingPath heads;
  for (const auto& line : evenly_spaced_streamlines(plan, longer_m / across)) {
    std::vector<Vec2> on_page;
    for (const Vec2 p : line) on_page.push_back(page.frame().to_page(p));
    page.canvas().stroke(DrawingPath::polyline(thinned(on_page)), stream_pen);
    add_heads_along(heads, on_page);
  }
  page.canvas().fill(heads, stream_pen.color);
}

void draw_arrows(MapPage& page, const Plan& plan, int across) {
  const auto layer = page.canvas().layer("arrows", page.frame().rect);
  const Grid& grid = plan.grid;
  const int stride = std::max(1, (std::max(grid.nx, grid.ny) + across - 1) / across);
  const double length_pt = 0.85 * stride * grid.cell_m * page.pt_per_m();
  const double head_pt = std::min(0.45 * length_pt, 5.0);
  DrawingPath shafts;
  DrawingPath heads;
  for (int iy = stride / 2; iy < grid.ny; iy += stride)
    for (int ix = stride / 2; ix < grid.nx; ix += stride) {
      const std::size_t i = grid.index({ix, iy});
      const double heading = plan.heading_rad[i];
      if (!std::isfinite(heading) || plan.region[i] == Region::obstacle) continue;
      const Vec2 along{std::cos(heading), -std::sin(heading)};
      const Vec2 center = page.frame().to_page(grid.center({ix, iy}));
      shafts.move_to(center - 0.5 * length_pt * along);
      shafts.line_to(center + (0.5 * length_pt - 0.8 * head_pt) * along);
      add_arrow_head(heads, center + 0.5 * length_pt * along, along, head_pt);
    }
  page.canvas().stroke(shafts, arrow_pen);
  page.canvas().fill(heads, arrow_pen.color);
}

LegendEntry field_entry(const char* name) {
  return {name, [](Canvas& canvas, const Rect& box) {
            const double y = box.y + 0.5 * box.height;
            canvas.stroke(DrawingPath::polyline({{box.x, y}, {box.right() - 4.0, y}}), stream_pen);
            DrawingPath head;
            add_arrow_head(head, {box.right(), y}, {1.0, 0.0}, stream_head_pt);
            canvas.fill(head, stream_pen.color);
          }};
}

}  // namespace

Picture draw_plan(const Plan& plan, const PlanPictureOptions& options) {
  require(options.streamlines_across >= 1 && options.streamlines_across <= 200 &&
              options.arrows_across >= 1 && options.arrows_across <= 200,
          "1 to 200 lines or arrows fit across");
  std::vector<LegendEntry> entries;
  if (options.streamlines) entries.push_back(field_entry("streamline"));
  if (options.arrows) entries.push_back(field_entry("command"));
  MapPage page(
      plan, {options.title, options.cost, options.mission, options.frame_pt, options.pixels_per_pt},
      std::move(entries));
  if (options.streamlines) draw_streamlines(page, plan, options.streamlines_across);
  if (options.arrows) draw_arrows(page, plan, options.arrows_across);
  page.mark_mission();
  return page.finish();
}

}  // namespace fairway
