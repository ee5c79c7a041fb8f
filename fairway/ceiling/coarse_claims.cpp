#include "fairway/ceiling/coarse_claims.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

/// Coarse nodes about a fine one along an axis: the first of four.
int first_near(const BallLattice& coarse, const BallLattice& fine, int node) {
  const double place = (node + 0.5) * fine.spacing / coarse.spacing - 0.5;
  return static_cast<int>(std::floor(place)) - 1;
}

}  // namespace

void add_coarse_claims(const CeilingLevel& coarse, const std::vector<Radius>& claims,
                       const BallLattice& l, std::vector<Radius>& fine) {
  const BallLattice& c = coarse.lattice;
  const int bins_each = l.headings / c.headings;
  for_rows(l.ny, [&](int from, int to) {
    for (int y = from; y < to; ++y) {
      const int cy = first_near(c, l, y);
      for (int x = 0; x < l.nx; ++x) {
        const int cx = first_near(c, l, x);
        int loses[16];
        for (int q = 0; q < 16; ++q) {
          const double dx = (cx + q % 4 + 0.5) * c.spacing - (x + 0.5) * l.spacing;
          const double dy = (cy + q / 4 + 0.5) * c.spacing - (y + 0.5) * l.spacing;
          loses[q] =
              static_cast<int>(std::ceil((std::hypot(dx, dy) + 1e-9) * units_per_turn_radius));
        }
        for (int k = 0; k < c.headings; ++k) {
          int best = 0;
          for (int q = 0; q < 16; ++q) {
            best = std::max(best, claims[c.at(k, cy + q / 4, cx + q % 4)] - loses[q]);
          }
          for (int b = 0; b < bins_each; ++b) {
            Radius& claim = fine[l.at(k * bins_each + b, y, x)];
            claim = std::max(claim, static_cast<Radius>(best));
          }
        }
      }
    }
  });
}

std::vector<std::uint32_t> open_tiles(const BallLattice& l, const CeilingCells& cells,
                                      const CeilingLevel* coarse) {
  std::vector<std::uint8_t> open(l.tiles(), coarse == nullptr ? 1 : 0);
  for (int k = 0; coarse != nullptr && k < l.headings; ++k) {
    const BallLattice& c = coarse->lattice;
    const int coarse_bin = k * c.headings / l.headings;
    for (int iy = 0; iy < l.cells_y; ++iy) {
      for (int ix = 0; ix < l.cells_x; ++ix) {
        const std::size_t bin = c.cell_bin(coarse_bin, iy, ix);
        const std::size_t cell =
            bin % (static_cast<std::size_t>(l.cells_x) * static_cast<std::size_t>(l.cells_y));
        if (coarse->closed[bin] != 0 || !cells.ordinary(cell)) continue;
        // With what lies a few nodes about it.
        const int low = std::max(0, iy * l.per_cell - tile_rows / 2) / tile_rows;
        const int high = std::min(l.ny - 1, (iy + 1) * l.per_cell + tile_rows / 2) / tile_rows;
        const int left = std::max(0, ix * l.per_cell - tile_rows / 2) / tile_columns;
        const int right = std::min(l.nx - 1, (ix + 1) * l.per_cell + tile_rows / 2) / tile_columns;
        for (int ty = low; ty <= high; ++ty) {
          for (int tx = left; tx <= right; ++tx) open[l.tile(k, ty, tx)] = 1;
        }
      }
    }
  }
  std::vector<std::uint32_t> list;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open[i] != 0) list.push_back(static_cast<std::uint32_t>(i));
  }
  return list;
}

}  // namespace fairway
