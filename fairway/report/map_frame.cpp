#include "fairway/report/map_frame.hpp"

#include <algorithm>

#include "fairway/report/ticks.hpp"

namespace fairway {
namespace {

constexpr double longest_aspect = 5.0;

}  // namespace

void frame_world(PlotFrame& frame, const Grid& grid) {
  const double width = grid.size() > 0 ? grid.width_m() : grid.cell_m;
  const double height = grid.size() > 0 ? grid.height_m() : grid.cell_m;
  const double shown_width = std::max(width, height / longest_aspect);
  const double shown_height = std::max(height, width / longest_aspect);
  frame.x = {grid.x0_m - 0.5 * (shown_width - width), grid.x0_m + 0.5 * (shown_width + width),
             "x (m)", shown_width >= 0.5 * shown_height ? 6 : 3};
  frame.y = {grid.y0_m - 0.5 * (shown_height - height), grid.y0_m + 0.5 * (shown_height + height),
             "y (m)", shown_height >= 0.5 * shown_width ? 6 : 3};
}

Vec2 size_of_world_pt(const PlotFrame& frame, double longer_pt) {
  const double width_m = frame.x.high - frame.x.low;
  const double height_m = frame.y.high - frame.y.low;
  const double scale = longer_pt / std::max(width_m, height_m);
  return {scale * width_m, scale * height_m};
}

void draw_scale_bar(Canvas& canvas, Vec2 corner, double pt_per_m) {
  const auto layer = canvas.layer("scale-bar");
  const double length_m = round_length_below(70.0 / pt_per_m);
  const double length_pt = length_m * pt_per_m;
  const double at = corner.y + 12.0;
  DrawingPath bar;
  bar.move_to({corner.x, at - 3.0}).line_to({corner.x, at + 3.0});
  bar.move_to({corner.x, at}).line_to({corner.x + length_pt, at});
  bar.move_to({corner.x + length_pt, at - 3.0}).line_to({corner.x + length_pt, at + 3.0});
  canvas.stroke(bar, {palette::ink, 1.2, {}});
  canvas.text(tick_label(length_m, length_m) + " m", {corner.x, at + 14.0});
}

}  // namespace fairway
