// The direction of steepest descent of a distance field at one cell, from its 3 x 3 neighbourhood.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/field/field.hpp"

namespace fairway {

/// A unit vector; (0, 0) when no neighbour is lower.
struct Descent {
  float x = 0.0F;
  float y = 0.0F;
};

/// Calls visit(flat index) for the neighbours of a cell that lie on the grid.
template <typename Visit>
void for_neighbours(const Grid& grid, std::uint32_t index, const Visit& visit) {
  const Cell c = grid.cell_at(index);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Cell n{c.ix + dx, c.iy + dy};
      if ((dx != 0 || dy != 0) && grid.contains(n))
        visit(static_cast<std::uint32_t>(grid.index(n)));
    }
  }
}

/// Three rows of a distance field, +inf beyond the grid.
class DescentRows {
 public:
  DescentRows(const std::vector<float>& distance, int nx, int ny, int iy)
      : nx_(nx),
        below_(iy > 0 ? row(distance, nx, iy - 1) : nullptr),
        here_(row(distance, nx, iy)),
        above_(iy + 1 < ny ? row(distance, nx, iy + 1) : nullptr) {}

  float at(int ix, int dy) const {
    const float* r = dy < 0 ? below_ : dy > 0 ? above_ : here_;
    return r == nullptr || ix < 0 || ix >= nx_ ? std::numeric_limits<float>::infinity() : r[ix];
  }

 private:
  static const float* row(const std::vector<float>& d, int nx, int iy) {
    return d.data() + static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx);
  }
  int nx_;
  const float* below_;
  const float* here_;
  const float* above_;
};

/// Descent of an eikonal field: the one of the eight triangles with the least value, with the
/// direction in which its linear interpolation is crossed (see eikonal.cpp). Every direction can
/// occur.
inline Descent descent_continuous(const DescentRows& rows, int ix) {
  constexpr float root_half = 0.70710678F;
  constexpr float root_two = 1.41421356F;
  float best = std::numeric_limits<float>::infinity();
  Descent out;
  const auto triangle = [&](float axial, float left, float right, float dx, float dy) {
    // `left` is the diagonal neighbour to the left of the axial one, seen from the cell.
    const float diagonal = std::min(left, right);
    const float side = left <= right ? 1.0F : -1.0F;
    const float drop = std::clamp(axial - diagonal, 0.0F, root_half);
    const float along = std::sqrt(1.0F - drop * drop);
    if (axial + along < best) {
      best = axial + along;  // direction (along, drop): tan = drop / along is the crossing point
      out = {dx * along - side * dy * drop, dy * along + side * dx * drop};
    }
    if (diagonal + root_two < best) {
      best = diagonal + root_two;
      out = {root_half * (dx - side * dy), root_half * (dy + side * dx)};
    }
  };
  const float e = rows.at(ix + 1, 0);
  const float w = rows.at(ix - 1, 0);
  const float n = rows.at(ix, 1);
  const float s = rows.at(ix, -1);
  const float ne = rows.at(ix + 1, 1);
  const float nw = rows.at(ix - 1, 1);
  const float se = rows.at(ix + 1, -1);
  const float sw = rows.at(ix - 1, -1);
  triangle(e, ne, se, 1.0F, 0.0F);
  triangle(n, nw, ne, 0.0F, 1.0F);
  triangle(w, sw, nw, -1.0F, 0.0F);
  triangle(s, se, sw, 0.0F, -1.0F);
  return out;
}

/// Descent among the eight neighbours, by cost plus step (1 and sqrt(2), or the paper's 1 and
/// 1.41, axial ones first): the printed gradient descent.
inline Descent descent_eight(const DescentRows& rows, int ix, Metric metric) {
  constexpr float root_half = 0.70710678F;
  const float here = rows.at(ix, 0);
  const float slanted = metric == Metric::paper ? 1.41F : 1.41421356F;
  float steepest = 0.0F;
  Descent out;
  const auto look = [&](int dx, int dy, float length, float unit) {
    const float slope = (here - rows.at(ix + dx, dy)) / length;
    if (slope > steepest) {
      steepest = slope;
      out = {static_cast<float>(dx) * unit, static_cast<float>(dy) * unit};
    }
  };
  look(1, 0, 1.0F, 1.0F);
  look(0, 1, 1.0F, 1.0F);
  look(-1, 0, 1.0F, 1.0F);
  look(0, -1, 1.0F, 1.0F);
  look(1, 1, slanted, root_half);
  look(-1, 1, slanted, root_half);
  look(-1, -1, slanted, root_half);
  look(1, -1, slanted, root_half);
  return out;
}

}  // namespace fairway
