#include "fairway/field/buffer_border.hpp"

#include <cmath>

#include "fairway/base/parallel.hpp"
#include "fairway/field/distance_transform.hpp"

namespace fairway {
namespace {

bool touches_buffer(const Grid& grid, const std::vector<Region>& region, int ix, int iy) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Cell c{ix + dx, iy + dy};
      if (grid.contains(c) && region[grid.index(c)] == Region::buffer) return true;
    }
  }
  return false;
}

}  // namespace

BufferBorder buffer_border(const Grid& grid, const std::vector<Region>& region,
                           std::span<const float> cost_cells) {
  std::vector<std::uint8_t> border(grid.size());
  for_rows(grid.ny, [&](int first, int last) {
    for (int iy = first; iy < last; ++iy) {
      for (int ix = 0; ix < grid.nx; ++ix) {
        const std::size_t i = grid.index({ix, iy});
        border[i] = std::isfinite(cost_cells[i]) && touches_buffer(grid, region, ix, iy) ? 1 : 0;
      }
    }
  });
  BufferBorder out;
  out.nearest.resize(grid.size());
  distance_transform(border, grid.nx, grid.ny, {{}, out.nearest});
  return out;
}

}  // namespace fairway
