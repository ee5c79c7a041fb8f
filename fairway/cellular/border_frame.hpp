// Quarter turns of a cell about its centre, which transfer results for one border to the other
// three.
#pragma once

#include "fairway/base/vec2.hpp"
#include "fairway/vehicle/side.hpp"

namespace fairway {

/// A point of the cell [0, cell_m]^2 after `quarters` quarter turns counter-clockwise.
constexpr Vec2 turned_in_cell(Vec2 p, int quarters, double cell_m) {
  switch (quarters & 3) {
    case 1:
      return {cell_m - p.y, p.x};
    case 2:
      return {cell_m - p.x, cell_m - p.y};
    case 3:
      return {p.y, cell_m - p.x};
    default:
      return p;
  }
}

/// Quarter turns counter-clockwise that take one side to another, 0 .. 3.
constexpr int quarters_between(Side from, Side to) {
  return (static_cast<int>(to) - static_cast<int>(from)) & 3;
}

constexpr Side turned(Side side, int quarters) {
  return static_cast<Side>((static_cast<int>(side) + quarters) & 3);
}

/// The point `along_m` along a side, in the direction of +x or +y.
constexpr Vec2 point_on(Side side, double along_m, double cell_m) {
  const double at = side == Side::right || side == Side::top ? cell_m : 0.0;
  return side == Side::right || side == Side::left ? Vec2{at, along_m} : Vec2{along_m, at};
}

}  // namespace fairway
