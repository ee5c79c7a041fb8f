#include "fairway/report/map_panels.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/report/goal_outline.hpp"
#include "fairway/report/hatch.hpp"
#include "fairway/report/map_frame.hpp"
#include "fairway/report/mission_marks.hpp"

namespace fairway {
namespace {

constexpr double margin_pt = 8.0;
constexpr double title_room_pt = 22.0;
constexpr double caption_room_pt = 16.0;
constexpr double gap_pt = 9.0;
constexpr double gap_to_side_pt = 16.0;
constexpr double arrow_pt = 13.0;
constexpr double pattern_spacing_pt = 3.6;
const TextStyle title_style{.size_pt = 11.0, .bold = true};
const TextStyle note_style{.size_pt = 7.5, .anchor = Anchor::end, .color = palette::faint_ink};
const Pen goal_pen{palette::goal_pattern, 0.6, {}};

double caption_width_pt(const PanelCaption& caption) {
  const double arrow = caption.heading_rad ? arrow_pt + 5.0 : 0.0;
  const double note = caption.note.empty() ? 0.0 : text_width_pt(caption.note, note_style) + 8.0;
  return arrow + text_width_pt(caption.name) + note;
}

void draw_heading_arrow(Canvas& canvas, Vec2 middle, double heading_rad) {
  const Vec2 along{std::cos(heading_rad), -std::sin(heading_rad)};
  const Vec2 tip = middle + 0.5 * arrow_pt * along;
  canvas.stroke(DrawingPath::polyline({middle - 0.5 * arrow_pt * along, tip - 3.0 * along}),
                {palette::ink, 1.2, {}});
  DrawingPath head;
  add_arrow_head(head, tip, along, 5.5);
  canvas.fill(head, palette::ink);
}

}  // namespace

MapPanels::MapPanels(const VerdictMap& map, const MapPanelsOptions& options,
                     std::vector<PanelCaption> captions, std::vector<LegendEntry> entries)
    : map_(map), options_(options), captions_(std::move(captions)), entries_(std::move(entries)) {
  require(options.columns >= 1 && !captions_.empty(), "a page of panels has at least one panel");
  require(options.panel_pt >= 30.0 && options.panel_pt <= 1000.0, "panel_pt is in 30..1000");
  require(options.pixels_per_pt >= 0.5 && options.pixels_per_pt <= 8.0,
          "pixels_per_pt is in 0.5..8");
  require(map.kind.size() == map.samples() && map.count.size() == map.samples() &&
              map.verdict.size() == map.heading_rad.size() * map.samples(),
          "a verdict map's arrays have one entry per sample");
  const auto has = [&](CellKind kind) {
    return std::find(map.kind.begin(), map.kind.end(), kind) != map.kind.end();
  };
  if (has(CellKind::obstacle)) entries_.push_back(area_entry("obstacle", palette::obstacle));
  if (has(CellKind::target))
    entries_.push_back(hatched_entry("goal", palette::goal, goal_pen, true, false));

  frame_world(world_, map.grid);
  size_pt_ = size_of_world_pt(world_, options.panel_pt);
  double widest = size_pt_.x;
  for (const auto& caption : captions_) widest = std::max(widest, caption_width_pt(caption));
  step_x_pt_ = widest + gap_pt;
  top_pt_ = margin_pt + (options.title.empty() ? 0.0 : title_room_pt);
  const auto panels = static_cast<int>(captions_.size());
  const int columns = std::min(options.columns, panels);
  const int rows = (panels + columns - 1) / columns;
  const double side_x_pt = margin_pt + columns * step_x_pt_ - gap_pt + gap_to_side_pt;
  const double side_width = std::max(legend_width_pt(entries_), 70.0);
  const double side_height =
      caption_room_pt + legend_row_pt * static_cast<double>(entries_.size()) + scale_bar_room_pt;
  const double title_width = text_width_pt(options.title, title_style);
  const double height = rows * (size_pt_.y + caption_room_pt + gap_pt) - gap_pt;
  canvas_.emplace(std::max(side_x_pt + side_width, margin_pt + title_width) + margin_pt,
                  top_pt_ + std::max(height, side_height) + margin_pt, options.pixels_per_pt,
                  options.title);
}

Rect MapPanels::place_of(std::size_t k) const {
  const auto columns = static_cast<std::size_t>(options_.columns);
  const auto column = static_cast<double>(k % columns);
  const auto row = static_cast<double>(k / columns);
  return {margin_pt + column * step_x_pt_,
          top_pt_ + caption_room_pt + row * (size_pt_.y + caption_room_pt + gap_pt), size_pt_.x,
          size_pt_.y};
}

PlotFrame MapPanels::frame(std::size_t k) const { return {place_of(k), world_.x, world_.y}; }

Raster MapPanels::raster_of(const std::function<Color(std::size_t)>& color) const {
  Raster raster{map_.nx, map_.ny, {}};
  raster.pixels.reserve(map_.samples());
  for (int iy = map_.ny; iy-- > 0;) {
    for (int ix = 0; ix < map_.nx; ++ix) {
      const std::size_t i = map_.index(ix, iy);
      raster.pixels.push_back(map_.kind[i] == CellKind::ordinary   ? color(i)
                              : map_.kind[i] == CellKind::obstacle ? palette::obstacle
                                                                   : palette::goal);
    }
  }
  return raster;
}

void MapPanels::draw_panel(std::size_t k, const std::function<Color(std::size_t)>& color,
                           const std::vector<SamplePattern>& patterns) {
  require(k < captions_.size(), "a panel has a caption");
  const Rect rect = place_of(k);
  const PlotFrame frame_of_panel = frame(k);
  {
    const auto layer = canvas_->layer(fmt::format("panel-{}", k + 1), rect);
    if (map_.samples() > 0) {
      const Grid blocks{map_.nx, map_.ny, map_.grid.x0_m, map_.grid.y0_m,
                        map_.grid.cell_m * map_.cells_per_sample};
      const Vec2 corner = frame_of_panel.to_page(blocks.corner({0, map_.ny}));
      const Vec2 other = frame_of_panel.to_page(blocks.corner({map_.nx, 0}));
      canvas_->image(raster_of(color),
                     {corner.x, corner.y, other.x - corner.x, other.y - corner.y});
      const auto stroke = [&](const SamplePattern& pattern) {
        const auto covers = [&](Vec2 page) {
          const Cell block = blocks.cell_of(frame_of_panel.from_page(page));
          return blocks.contains(block) && pattern.covers(blocks.index(block));
        };
        if (pattern.rising)
          canvas_->stroke(hatch(rect, pattern_spacing_pt, true, covers), pattern.pen);
        if (pattern.falling)
          canvas_->stroke(hatch(rect, pattern_spacing_pt, false, covers), pattern.pen);
      };
      for (const SamplePattern& pattern : patterns) stroke(pattern);
      const auto target = [&](std::size_t i) { return map_.kind[i] == CellKind::target; };
      stroke({goal_pen, true, false, target});
      canvas_->stroke(
          outline_of_cells(
              blocks, frame_of_panel,
              [&](Cell block) { return blocks.contains(block) && target(blocks.index(block)); }),
          {palette::goal_pattern, 0.9, {}});
    }
  }
  const auto layer = canvas_->layer(fmt::format("caption-{}", k + 1));
  canvas_->stroke(rect.outline(), {palette::ink, 0.6, {}});
  draw_caption(captions_[k], rect);
}

void MapPanels::draw_caption(const PanelCaption& caption, const Rect& panel) {
  double x = panel.x;
  if (caption.heading_rad) {
    draw_heading_arrow(*canvas_, {x + 0.5 * arrow_pt, panel.y - 8.0}, *caption.heading_rad);
    x += arrow_pt + 5.0;
  }
  canvas_->text(caption.name, {x, panel.y - 5.0});
  const double right = panel.x + step_x_pt_ - gap_pt;
  if (!caption.note.empty()) canvas_->text(caption.note, {right, panel.y - 5.0}, note_style);
}

Picture MapPanels::finish() {
  const int columns = std::min(options_.columns, static_cast<int>(captions_.size()));
  const double x = margin_pt + columns * step_x_pt_ - gap_pt + gap_to_side_pt;
  const double y = top_pt_ + caption_room_pt;
  draw_legend(*canvas_, {x, y}, entries_);
  draw_scale_bar(*canvas_, {x, y + legend_row_pt * static_cast<double>(entries_.size())},
                 size_pt_.x / (world_.x.high - world_.x.low));
  if (!options_.title.empty()) {
    const auto layer = canvas_->layer("title");
    canvas_->text(options_.title, {margin_pt, margin_pt + 11.0}, title_style);
  }
  return canvas_->finish();
}

}  // namespace fairway
