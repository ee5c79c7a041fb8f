// The grid of square cells on which maps, fields and plans live.
//
// Cell (ix, iy) covers [x0_m + ix*cell_m, x0_m + (ix+1)*cell_m] by the same in y. Arrays over a
// grid are [iy][ix], iy = 0 lowest y; `index` gives the position in a flat array.
#pragma once

#include <cmath>
#include <cstddef>

#include "fairway/base/vec2.hpp"

namespace fairway {

struct Cell {
  int ix = 0;
  int iy = 0;
  friend constexpr bool operator==(Cell, Cell) = default;
};

struct Grid {
  int nx = 0;
  int ny = 0;
  double x0_m = 0.0;
  double y0_m = 0.0;
  double cell_m = 1.0;

  friend constexpr bool operator==(const Grid&, const Grid&) = default;

  constexpr std::size_t size() const {
    return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny);
  }
  constexpr bool contains(Cell c) const { return c.ix >= 0 && c.ix < nx && c.iy >= 0 && c.iy < ny; }
  constexpr std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.iy) * static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(c.ix);
  }
  constexpr Cell cell_at(std::size_t index) const {
    const auto n = static_cast<std::size_t>(nx);
    return {static_cast<int>(index % n), static_cast<int>(index / n)};
  }
  constexpr Vec2 corner(Cell c) const { return {x0_m + c.ix * cell_m, y0_m + c.iy * cell_m}; }
  constexpr Vec2 center(Cell c) const {
    return {x0_m + (c.ix + 0.5) * cell_m, y0_m + (c.iy + 0.5) * cell_m};
  }
  /// The cell whose half-open square holds `p`; may lie outside the grid. `p` must be finite and
  /// within 2^31 cells of the origin.
  Cell cell_of(Vec2 p) const {
    return {static_cast<int>(std::floor((p.x - x0_m) / cell_m)),
            static_cast<int>(std::floor((p.y - y0_m) / cell_m))};
  }
  constexpr double width_m() const { return nx * cell_m; }
  constexpr double height_m() const { return ny * cell_m; }
};

}  // namespace fairway
