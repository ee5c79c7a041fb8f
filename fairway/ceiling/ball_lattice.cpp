#include "fairway/ceiling/ball_lattice.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/heading.hpp"

namespace fairway {
namespace {

constexpr double coarsest_spacing = 0.27;
constexpr int coarsest_headings = 36;
// Beyond the end of a step, in nodes: how far its stencil looks, and the rings of wider_claim.
constexpr int beyond_step = 6;

}  // namespace

BallLattice ball_lattice(int cells_x, int cells_y, double cell, int level) {
  BallLattice l;
  const double finer = std::ldexp(1.0, level);
  l.cells_x = cells_x;
  l.cells_y = cells_y;
  l.per_cell = std::max(1, static_cast<int>(std::ceil(cell * finer / coarsest_spacing)));
  l.headings = coarsest_headings << level;
  // A step of 20 degrees, then of 15: it must be longer than nodes are apart, and shorter than
  // what turning to and fro within it could gain.
  l.turn_bins = level == 0 ? 2 : 3 << (level - 1);
  l.spacing = cell / l.per_cell;
  l.bin_rad = two_pi / l.headings;
  l.step = l.turn_bins * l.bin_rad;
  l.nx = cells_x * l.per_cell;
  l.ny = cells_y * l.per_cell;
  l.tiles_x = (l.nx + tile_columns - 1) / tile_columns;
  l.tiles_y = (l.ny + tile_rows - 1) / tile_rows;
  l.margin = std::max(8, static_cast<int>(std::ceil(l.step / l.spacing)) + beyond_step);
  l.stride = l.tiles_x * tile_columns + 2 * l.margin;
  l.plane = static_cast<std::size_t>(l.stride) *
            static_cast<std::size_t>(l.tiles_y * tile_rows + 2 * l.margin);
  return l;
}

}  // namespace fairway
