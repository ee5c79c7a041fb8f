// No flight is shorter: what the lengths of flights are compared with.
#pragma once

#include <functional>
#include <string>

#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// A length that no flight from a state to the mission's cells, clear of obstacles, is shorter
/// than; +inf where there is none. `name` says what it is: "a straight line". Several threads may
/// ask at once.
struct LengthBound {
  std::string name;
  std::function<double(const State&)> length_m;
};

/// Of a line that may bend at once but passes no obstacle cell: at least the distance to the
/// nearest goal cell, and at least the way around obstacles, as far as the grid's eight directions
/// tell it: up to 8 % less than the shortest line, and up to three cells.
///
/// Why no line is shorter. A shortest line runs straight between corners of obstacle cells. Of a
/// straight piece from grid point to grid point that meets only free cells, the grid points just
/// below it (or beside it, if it is steep) are a way along the sides and diagonals of cells that it
/// meets, and that way is no longer than the octile length of the piece: at most 1 / cos(22.5 deg)
/// of its length. At each end of the line, which need not be a grid point, it may be longer by a
/// diagonal.
[[nodiscard]] LengthBound line_around_obstacles(const Plan& plan);

}  // namespace fairway
