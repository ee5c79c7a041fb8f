// The closed loop under proof: a plan's commands and what each cell means for the verdict. A view
// of the arrays, so that it can refer to a mapped file.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fairway/base/grid.hpp"
#include "fairway/vehicle/cell_shape.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// What a cell means: the region of interest (the goal, unless another was requested) ends a flight
/// with `reach`, an obstacle with `collide`.
enum class CellKind : std::uint8_t { ordinary = 0, obstacle = 1, target = 2, outside = 3 };

/// Default for the most borders that one flight to the section may cross, counting branches, before
/// it is given up as undecided.
inline constexpr int usual_most_crossings = 3000;

struct Flow {
  Grid grid;
  Vehicle vehicle;
  const float* heading_rad = nullptr;  ///< [iy][ix]; NaN: no command, crossed straight
  const CellKind* kind = nullptr;      ///< [iy][ix]; never `outside`

  CellShape shape() const { return {grid.cell_m, vehicle.turn_radius_m}; }
  CellKind kind_at(Cell c) const {
    return grid.contains(c) ? kind[grid.index(c)] : CellKind::outside;
  }
};

}  // namespace fairway
