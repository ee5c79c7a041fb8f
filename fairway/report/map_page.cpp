#include "fairway/report/map_page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/report/cell_layer.hpp"
#include "fairway/report/contours.hpp"
#include "fairway/report/goal_outline.hpp"
#include "fairway/report/hatch.hpp"
#include "fairway/report/map_frame.hpp"
#include "fairway/report/mission_marks.hpp"
#include "fairway/report/ticks.hpp"

namespace fairway {
namespace {

constexpr double margin_pt = 8.0;
constexpr double title_room_pt = 20.0;
constexpr double gap_to_side_pt = 16.0;
constexpr double color_bar_width_pt = 14.0;
constexpr double color_bar_height_pt = 130.0;
constexpr double color_bar_room_pt = color_bar_height_pt + 34.0;
constexpr int most_contour_samples = 500;
constexpr int contours_wanted = 7;

const Pen buffer_pen{palette::buffer_pattern, 0.5, {}};
const Pen goal_pen{palette::goal_pattern, 0.8, {}};
const Pen unreachable_pen{palette::unreachable_pattern, 0.6, {}};
const Pen contour_pen{{70, 90, 110, 0.75}, 0.5, {}};

void check(const Plan& plan, const MapPageOptions& options) {
  const std::size_t cells = plan.grid.nx > 0 && plan.grid.ny > 0 ? plan.grid.size() : 0;
  require(plan.heading_rad.size() == cells && plan.region.size() == cells &&
              plan.cost_m.size() == cells,
          "a plan's arrays have one entry per cell");
  require(plan.grid.cell_m > 0.0, "a plan's cells have a size");
  require(options.frame_pt >= 100.0 && options.frame_pt <= 2000.0, "frame_pt is in 100..2000");
  require(options.pixels_per_pt >= 0.5 && options.pixels_per_pt <= 8.0,
          "pixels_per_pt is in 0.5..8");
}

std::size_t count_if_cell(const Plan& plan, auto&& test) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < plan.region.size(); ++i) count += test(i) ? 1U : 0U;
  return count;
}

std::vector<LegendEntry> region_entries(const Plan& plan, bool cost) {
  const auto has = [&](Region region) {
    return std::find(plan.region.begin(), plan.region.end(), region) != plan.region.end();
  };
  std::vector<LegendEntry> entries;
  if (!cost && has(Region::free)) entries.push_back(area_entry("safe start", palette::free));
  if (has(Region::buffer))
    entries.push_back(hatched_entry("buffer", palette::buffer, buffer_pen, false, true));
  if (has(Region::obstacle)) entries.push_back(area_entry("obstacle", palette::obstacle));
  if (has(Region::goal))
    entries.push_back(hatched_entry("goal", palette::goal, goal_pen, true, false));
  if (const auto cells =
          count_if_cell(plan, [&](std::size_t i) { return is_unreachable(plan, i); }))
    entries.push_back(
        hatched_entry(fmt::format("cut off ({} cell{})", cells, cells == 1 ? "" : "s"),
                      palette::unreachable, unreachable_pen, true, true));
  return entries;
}

}  // namespace

MapPage::MapPage(const Plan& plan, const MapPageOptions& options, std::vector<LegendEntry> entries)
    : plan_(plan), options_(options), entries_(std::move(entries)) {
  check(plan, options);
  largest_cost_m_ = largest_cost_m(plan);
  if (!(largest_cost_m_ > 0.0)) options_.cost = false;  // a single value: no scale
  for (auto& entry : region_entries(plan, options_.cost)) entries_.push_back(std::move(entry));
  if (options_.mission) entries_.push_back(mission_entry(*options_.mission));
  lay_out();
  draw_cells();
  if (options_.cost) draw_contours();
  draw_patterns();
}

void MapPage::lay_out() {
  frame_world(frame_, plan_.grid);
  const Vec2 size = size_of_world_pt(frame_, options_.frame_pt);
  const double top = margin_pt + (options_.title.empty() ? 0.0 : title_room_pt);
  frame_.rect = {margin_pt + y_axis_room_pt(frame_.y), top, size.x, size.y};
  side_x_pt_ = frame_.rect.right() + gap_to_side_pt;
  const double side_height = (options_.cost ? color_bar_room_pt : 0.0) +
                             legend_row_pt * static_cast<double>(entries_.size()) +
                             scale_bar_room_pt;
  const double side_width = std::max(legend_width_pt(entries_), 70.0);
  const double title_width = text_width_pt(options_.title, {.size_pt = 11.0, .bold = true});
  canvas_.emplace(std::max(side_x_pt_ + side_width, frame_.rect.x + title_width) + margin_pt,
                  top + std::max(frame_.rect.height + x_axis_room_pt, side_height) + margin_pt,
                  options_.pixels_per_pt, options_.title);
}

void MapPage::draw_cells() {
  const auto layer = canvas_->layer("cells", frame_.rect);
  if (plan_.grid.size() == 0) return;
  const auto most_pixels = static_cast<int>(options_.frame_pt * options_.pixels_per_pt);
  const CellLayer cells = cell_layer(plan_, options_.cost, most_pixels);
  const double pixel_m = cells.cells_per_pixel * plan_.grid.cell_m;
  const Vec2 low{plan_.grid.x0_m, plan_.grid.y0_m};
  const Vec2 corner = frame_.to_page({low.x, low.y + cells.raster.height * pixel_m});
  canvas_->image(cells.raster, {corner.x, corner.y, cells.raster.width * pixel_m * pt_per_m(),
                                cells.raster.height * pixel_m * pt_per_m()});
}

void MapPage::draw_patterns() {
  const auto layer = canvas_->layer("patterns", frame_.rect);
  const auto in = [&](auto&& test) {
    return [this, test](Vec2 page) {
      const Cell cell = plan_.grid.cell_of(frame_.from_page(page));
      return plan_.grid.contains(cell) && test(plan_.grid.index(cell));
    };
  };
  const Rect& area = frame_.rect;
  canvas_->stroke(hatch(area, 5.0, false,
                        in([this](std::size_t i) { return plan_.region[i] == Region::buffer; })),
                  buffer_pen);
  canvas_->stroke(
      hatch(area, 4.0, true, in([this](std::size_t i) { return plan_.region[i] == Region::goal; })),
      goal_pen);
  const auto unreachable = in([this](std::size_t i) { return is_unreachable(plan_, i); });
  canvas_->stroke(hatch(area, 4.0, true, unreachable), unreachable_pen);
  canvas_->stroke(hatch(area, 4.0, false, unreachable), unreachable_pen);
  canvas_->stroke(goal_outline(plan_, frame_), {palette::goal_pattern, 1.0, {}});
}

void MapPage::draw_contours() {
  const auto layer = canvas_->layer("contours", frame_.rect);
  const Grid& grid = plan_.grid;
  const int k = (std::max(grid.nx, grid.ny) + most_contour_samples - 1) / most_contour_samples;
  const int nx = (grid.nx + k - 1) / k;
  const int ny = (grid.ny + k - 1) / k;
  std::vector<float> samples;
  samples.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  for (int iy = 0; iy < ny; ++iy)
    for (int ix = 0; ix < nx; ++ix) {
      const std::size_t i = grid.index({ix * k, iy * k});
      const bool shaded = plan_.region[i] == Region::free || plan_.region[i] == Region::goal;
      samples.push_back(shaded ? plan_.cost_m[i] : std::numeric_limits<float>::quiet_NaN());
    }
  for (const double level : ticks_between(0.0, largest_cost_m_, contours_wanted).values) {
    if (level <= 0.0) continue;
    DrawingPath path;
    for (const auto& line : contour_lines(nx, ny, samples, level))
      for (std::size_t v = 0; v < line.size(); ++v) {
        const Vec2 at = frame_.to_page({grid.x0_m + (line[v].x * k + 0.5) * grid.cell_m,
                                        grid.y0_m + (line[v].y * k + 0.5) * grid.cell_m});
        v == 0 ? path.move_to(at) : path.line_to(at);
      }
    canvas_->stroke(path, contour_pen);
  }
}

double MapPage::draw_color_bar(Vec2 corner) {
  const auto layer = canvas_->layer("color-bar");
  canvas_->text("cost to go (m)", {corner.x, corner.y + 7.0});
  constexpr int shades = 128;
  Raster raster{1, shades, {}};
  for (int i = 0; i < shades; ++i) raster.pixels.push_back(cost_ramp((shades - 0.5 - i) / shades));
  const Rect bar{corner.x, corner.y + 16.0, color_bar_width_pt, color_bar_height_pt};
  canvas_->image(raster, bar);
  const Ticks ticks = ticks_between(0.0, largest_cost_m_, contours_wanted);
  const std::size_t every = ticks.values.size() > 12 ? 2 : 1;
  DrawingPath marks;
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double y = bar.bottom() - ticks.values[i] / largest_cost_m_ * bar.height;
    marks.move_to({bar.x, y}).line_to({bar.right(), y});
    if (i % every == 0)
      canvas_->text(tick_label(ticks.values[i], ticks.step), {bar.right() + 5.0, y + 3.0},
                    {.size_pt = 8.0});
  }
  canvas_->stroke(marks, contour_pen);
  canvas_->stroke(bar.outline(), {palette::ink, 0.6, {}});
  return corner.y + color_bar_room_pt;
}

void MapPage::draw_side_column() {
  double y = frame_.rect.y;
  if (options_.cost) y = draw_color_bar({side_x_pt_, y});
  draw_legend(*canvas_, {side_x_pt_, y}, entries_);
  y += legend_row_pt * static_cast<double>(entries_.size());

  draw_scale_bar(*canvas_, {side_x_pt_, y}, pt_per_m());
}

void MapPage::mark_mission() {
  if (options_.mission) draw_mission(*canvas_, frame_, *options_.mission);
}

Picture MapPage::finish() {
  draw_axes(*canvas_, frame_, false);
  draw_side_column();
  if (!options_.title.empty()) {
    const auto layer = canvas_->layer("title");
    canvas_->text(options_.title, {frame_.rect.x, margin_pt + 11.0},
                  {.size_pt = 11.0, .bold = true});
  }
  return canvas_->finish();
}

}  // namespace fairway
