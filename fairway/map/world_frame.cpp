#include "fairway/map/world_frame.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"

namespace fairway {

namespace {

// Columns (or rows) before `first`, and those from `last` on, touch the grown outside.
struct InsideRange {
  int first = 0;
  int last = 0;
};

InsideRange inside_range(int count, double cell_m, double length_m, double growth_m) {
  const double slack_m = cell_slack * cell_m;
  InsideRange range{0, count};
  while (range.first < count && range.first * cell_m < growth_m - slack_m) ++range.first;
  while (range.last > range.first && range.last * cell_m > length_m - growth_m + slack_m)
    --range.last;
  return range;
}

}  // namespace

Grid grid_over(const MapExtent& extent, const RasteriseOptions& options) {
  const double columns = std::max(1.0, std::ceil(extent.width_m / options.cell_m - cell_slack));
  const double rows = std::max(1.0, std::ceil(extent.height_m / options.cell_m - cell_slack));
  const double ring = options.outside_is_obstacle ? 2.0 : 0.0;
  // Written so that NaN is refused, too.
  if (!((columns + ring) * (rows + ring) <= static_cast<double>(options.max_cells)) ||
      columns + ring > 2147483647.0 || rows + ring > 2147483647.0)
    throw InputError(
        "map.cell_m",
        fmt::format(
            "{} m cells on a map of {} m by {} m give a grid of {} by {}, expected at most {} "
            "cells; use larger cells",
            length_text(options.cell_m), length_text(extent.width_m), length_text(extent.height_m),
            length_text(columns + ring), length_text(rows + ring), options.max_cells));
  for (const double corner_m : {extent.lower_left_m.x, extent.lower_left_m.y})
    if (!(std::abs(corner_m) <= 1e12 * options.cell_m))
      throw InputError("map.cell_m", fmt::format("the map's corner is at {} m: too far from 0 to "
                                                 "distinguish cells of {} m",
                                                 corner_m, options.cell_m));
  return {static_cast<int>(columns), static_cast<int>(rows), extent.lower_left_m.x,
          extent.lower_left_m.y, options.cell_m};
}

Grid close_world(const Grid& inner, const MapExtent& extent, const RasteriseOptions& options,
                 std::vector<std::uint8_t>& cells) {
  if (!options.outside_is_obstacle) return inner;
  const InsideRange xs = inside_range(inner.nx, inner.cell_m, extent.width_m, options.growth_m);
  const InsideRange ys = inside_range(inner.ny, inner.cell_m, extent.height_m, options.growth_m);
  const Grid outer{inner.nx + 2, inner.ny + 2, inner.x0_m - inner.cell_m, inner.y0_m - inner.cell_m,
                   inner.cell_m};
  std::vector<std::uint8_t> closed(outer.size(), 1);
  for (int iy = ys.first; iy < ys.last; ++iy) {
    const auto from = cells.begin() + static_cast<std::ptrdiff_t>(inner.index({xs.first, iy}));
    std::copy(from, from + (xs.last - xs.first),
              closed.begin() + static_cast<std::ptrdiff_t>(outer.index({xs.first + 1, iy + 1})));
  }
  cells = std::move(closed);
  return outer;
}

}  // namespace fairway
