// The closed loop under proof: a plan's commands and what each cell means for the verdict. A view:
// it owns nothing, so that it can look into a mapped file.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fairway/vehicle/cell_enclosure.hpp"

namespace fairway {

/// What a cell means: the region of interest (the goal, unless another was asked for) ends a flight
/// with `reach`, an obstacle with `collide`.
enum class CellKind : std::uint8_t { ordinary = 0, obstacle = 1, target = 2, outside = 3 };

struct Flow {
  int nx = 0;
  int ny = 0;
  double x0_m = 0.0;
  double y0_m = 0.0;
  CellSize size;
  double speed_mps = 1.0;
  const float* heading_rad = nullptr;  ///< [iy][ix]; NaN: no command, crossed straight
  const CellKind* kind = nullptr;      ///< [iy][ix]; never `outside`

  bool contains(int ix, int iy) const { return ix >= 0 && ix < nx && iy >= 0 && iy < ny; }
  std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(ix);
  }
  std::size_t cells() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  CellKind kind_at(int ix, int iy) const {
    return contains(ix, iy) ? kind[index(ix, iy)] : CellKind::outside;
  }
};

}  // namespace fairway
