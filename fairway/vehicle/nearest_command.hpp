// Which command holds in a cell that has none: that of the nearest cell that has one, by distance
// between centres, of equally near ones the first in the array. Proof and vehicle use this file, so
// that they agree. No heap, no exceptions.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>

#include "fairway/base/grid.hpp"

namespace fairway {

/// Into `row`, [iy][ix]: the row of the nearest cell of the same column that has a command, the
/// lower of equally near ones; -1 when the column has none. Cost: linear.
inline void find_nearest_rows(const Grid& grid, const float* heading_rad, int* row) noexcept {
  constexpr int none = -1;
  for (int ix = 0; ix < grid.nx; ++ix) {
    int below = none;
    for (int iy = 0; iy < grid.ny; ++iy) {
      if (!std::isnan(heading_rad[grid.index({ix, iy})])) below = iy;
      row[grid.index({ix, iy})] = below;
    }
    int above = none;
    for (int iy = grid.ny; iy-- > 0;) {
      if (!std::isnan(heading_rad[grid.index({ix, iy})])) above = iy;
      int& nearest = row[grid.index({ix, iy})];
      if (above != none && (nearest == none || above - iy < iy - nearest)) nearest = above;
    }
  }
}

/// The index of the cell whose command holds in `cell`; grid.size() when no cell has a command.
/// `row` as found above. Cost: linear in the distance.
inline std::size_t cell_in_command(const Grid& grid, const int* row, Cell cell) noexcept {
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  std::size_t found = grid.size();
  for (std::int64_t dx = 0; dx < grid.nx && dx * dx <= least; ++dx) {
    for (const std::int64_t x : {cell.ix - dx, cell.ix + dx}) {
      if (x < 0 || x >= grid.nx) continue;
      const int y = row[grid.index({static_cast<int>(x), cell.iy})];
      if (y < 0) continue;
      const std::int64_t dy = y - cell.iy;
      const std::int64_t distance = dx * dx + dy * dy;
      const std::size_t candidate = grid.index({static_cast<int>(x), y});
      if (distance < least || (distance == least && candidate < found)) {
        least = distance;
        found = candidate;
      }
    }
  }
  return found;
}

}  // namespace fairway
