#include "fairway/verify/bitmap_region.hpp"

#include <algorithm>
#include <cstddef>

namespace fairway {

std::vector<std::uint8_t> cells_of(const Plan& plan, Region kind) {
  std::vector<std::uint8_t> cells(plan.region.size());
  std::transform(plan.region.begin(), plan.region.end(), cells.begin(),
                 [kind](Region region) { return std::uint8_t{region == kind}; });
  return cells;
}

std::vector<std::uint8_t> cells_inside(const Grid& grid, Vec2 corner_m, Vec2 opposite_m) {
  const auto [west, east] = std::minmax(corner_m.x, opposite_m.x);
  const auto [south, north] = std::minmax(corner_m.y, opposite_m.y);
  std::vector<std::uint8_t> cells(grid.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell c = grid.cell_at(i);
    const Vec2 low = grid.corner(c);
    const Vec2 high = grid.corner({c.ix + 1, c.iy + 1});
    cells[i] = low.x >= west && high.x <= east && low.y >= south && high.y <= north ? 1 : 0;
  }
  return cells;
}

}  // namespace fairway
