#include "fairway/report/draw_cell_sets.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/report/canvas.hpp"
#include "fairway/report/legend.hpp"
#include "fairway/report/plot_frame.hpp"

namespace fairway {
namespace {

constexpr double panel_pt = 170.0;
constexpr double step_x_pt = 232.0;
constexpr double step_y_pt = 250.0;
constexpr int rows = 360;  // headings of a panel's picture

Color color_of(Side side) {
  return color_of_oklch(0.74, 0.13, 30.0 + 90.0 * static_cast<double>(side));
}

/// The mean of the colours of the sides that hold; white for none.
template <typename Holds>
Color mixed(const Holds& holds) {
  std::array<double, 3> sum{};
  int count = 0;
  for (const Side side : all_sides) {
    if (!holds(side)) continue;
    const Color c = color_of(side);
    sum[0] += c.red;
    sum[1] += c.green;
    sum[2] += c.blue;
    ++count;
  }
  if (count == 0) return palette::white;
  const auto mean = [&](std::size_t i) {
    return static_cast<std::uint8_t>(std::lround(sum[i] / count));
  };
  return {mean(0), mean(1), mean(2)};
}

/// `row_of(side)`: the sets, place by place, that are painted in the colour of that side.
template <typename RowOf>
void draw_panel(Canvas& canvas, const PlotFrame& frame, const std::string& name, std::size_t places,
                const RowOf& row_of) {
  Raster raster{static_cast<int>(places), rows, {}};
  for (int row = 0; row < rows; ++row) {
    const double share = 1.0 - (row + 0.5) / rows;
    const double heading_rad = (frame.y.low + share * (frame.y.high - frame.y.low)) * pi / 180.0;
    for (std::size_t i = 0; i < places; ++i) {
      raster.pixels.push_back(mixed([&](Side side) { return row_of(side)[i].holds(heading_rad); }));
    }
  }
  {
    const auto layer = canvas.layer(name, frame.rect);
    canvas.image(raster, frame.rect);
  }
  draw_axes(canvas, frame, false);
}

}  // namespace

Picture draw_cell_sets(const CellSets& sets, const std::string& title) {
  require(!sets.along_m.empty(), "cellular sets have at least one place");
  const double width = 70.0 + 4 * step_x_pt + 90.0;
  Canvas canvas(width, 60.0 + 2 * step_y_pt, 2.0, title);
  for (const Side side : all_sides) {
    const double left = 62.0 + step_x_pt * static_cast<double>(side);
    const bool upright = side == Side::right || side == Side::left;
    const Axis along{0.0, sets.shape.cell_m, upright ? "y (m)" : "x (m)", 4};
    const auto turns = static_cast<double>(side) * 90.0;
    const auto frame_at = [&](int row, double from_deg) {
      return PlotFrame{{left, 56.0 + row * step_y_pt, panel_pt, panel_pt},
                       along,
                       {from_deg, from_deg + 180.0, "heading (degrees)", 5}};
    };
    const PlotFrame enters = frame_at(0, turns < 180.0 ? turns + 90.0 : turns - 270.0);
    draw_panel(canvas, enters, fmt::format("theta-{}", name_of(side)), sets.along_m.size(),
               [&](Side exit) -> const CellSets::Row& { return sets.theta_of(side, exit); });
    canvas.text(fmt::format("Θ: enters by {}", name_of(side)), {left, enters.rect.y - 8.0});
    const PlotFrame leaves = frame_at(1, turns - 90.0);
    draw_panel(canvas, leaves, fmt::format("phi-{}", name_of(side)), sets.along_m.size(),
               [&](Side entry) -> const CellSets::Row& { return sets.phi_of(entry, side); });
    canvas.text(fmt::format("Φ: leaves by {}", name_of(side)), {left, leaves.rect.y - 8.0});
  }
  const auto legend = [&](double y, const char* what) {
    std::vector<LegendEntry> entries{{what, {}}};
    for (const Side side : all_sides) entries.push_back(area_entry(name_of(side), color_of(side)));
    draw_legend(canvas, {70.0 + 4 * step_x_pt - 24.0, y}, entries);
  };
  legend(56.0, "leaves by");
  legend(56.0 + step_y_pt, "came in by");
  canvas.text(title, {14.0, 22.0}, {.size_pt = 11.0, .bold = true});
  return canvas.finish();
}

}  // namespace fairway
