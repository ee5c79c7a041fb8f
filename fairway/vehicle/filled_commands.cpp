#include "fairway/vehicle/filled_commands.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

constexpr int none = -1;

/// The row of the nearest cell that has, in the same column; of two as near, the lower one.
std::vector<int> nearest_rows(const Grid& grid, const std::function<bool(std::size_t)>& has) {
  std::vector<int> nearest(grid.size(), none);
  for (int ix = 0; ix < grid.nx; ++ix) {
    int below = none;
    for (int iy = 0; iy < grid.ny; ++iy) {
      if (has(grid.index({ix, iy}))) below = iy;
      nearest[grid.index({ix, iy})] = below;
    }
    int above = none;
    for (int iy = grid.ny; iy-- > 0;) {
      int& row = nearest[grid.index({ix, iy})];
      if (row == iy) above = iy;
      if (above != none && (row == none || above - iy < iy - row)) row = above;
    }
  }
  return nearest;
}

}  // namespace

std::vector<std::size_t> nearest_cells(const Grid& grid,
                                       const std::function<bool(std::size_t)>& has) {
  // First the nearest one in the same column, then along each row.
  const std::vector<int> rows = nearest_rows(grid, has);
  std::vector<std::size_t> nearest(grid.size(), grid.size());
  for_ranges(static_cast<std::size_t>(grid.ny), 1, [&](std::size_t a, std::size_t b) {
    for (int iy = static_cast<int>(a); iy < static_cast<int>(b); ++iy) {
      for (int ix = 0; ix < grid.nx; ++ix) {
        std::int64_t best = std::numeric_limits<std::int64_t>::max();
        std::size_t& from = nearest[grid.index({ix, iy})];
        for (std::int64_t dx = 0; dx < grid.nx && dx * dx <= best; ++dx) {
          for (const int x : {ix - static_cast<int>(dx), ix + static_cast<int>(dx)}) {
            if (x < 0 || x >= grid.nx) continue;
            const int row = rows[grid.index({x, iy})];
            if (row == none) continue;
            const std::int64_t dy = row - iy;
            const std::int64_t distance = dx * dx + dy * dy;
            const std::size_t candidate = grid.index({x, row});
            if (distance < best || (distance == best && candidate < from)) {
              best = distance;
              from = candidate;
            }
          }
        }
      }
    }
  });
  return nearest;
}

std::vector<float> filled_commands(const Grid& grid, const float* heading_rad) {
  std::vector<float> filled(heading_rad, heading_rad + grid.size());
  const auto nearest =
      nearest_cells(grid, [&](std::size_t cell) { return !std::isnan(heading_rad[cell]); });
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (nearest[cell] < grid.size()) filled[cell] = heading_rad[nearest[cell]];
  }
  return filled;
}

}  // namespace fairway
