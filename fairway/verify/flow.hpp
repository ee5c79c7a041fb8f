// The closed loop under proof: a plan's commands and what each cell means for the verdict. A view
// of the arrays, so that it can refer to a mapped file.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fairway/base/grid.hpp"
#include "fairway/vehicle/cell_shape.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/verdict.hpp"

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
  /// [iy][ix], 1 out of the mission's reach, where the plan holds; null: nowhere.
  const std::uint8_t* holding = nullptr;

  CellShape shape() const { return {grid.cell_m, vehicle.turn_radius_m}; }
  CellKind kind_at(Cell c) const {
    return grid.contains(c) ? kind[grid.index(c)] : CellKind::outside;
  }
  bool holds(std::size_t cell) const { return holding != nullptr && holding[cell] != 0; }
  /// The word for what is proved of a state in this cell: to be trapped where the plan holds is to
  /// hold.
  Verdict told(Verdict proved, Cell c) const {
    const bool is_hold = proved == Verdict::trapped && grid.contains(c) && holds(grid.index(c));
    return is_hold ? Verdict::hold : proved;
  }
};

}  // namespace fairway
