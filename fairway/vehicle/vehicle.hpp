// The vehicle: constant speed, bounded curvature (a Dubins vehicle; paper 1, Eqs. 1 and 2).
//   x' = v cos h, y' = v sin h, |h'| <= v / r.
#pragma once

#include "fairway/base/heading.hpp"
#include "fairway/base/vec2.hpp"

namespace fairway {

struct Vehicle {
  double speed_mps = 10.0;
  double turn_radius_m = 20.0;
  friend constexpr bool operator==(const Vehicle&, const Vehicle&) = default;
};

/// A configuration (x, y, h).
struct State {
  Vec2 position_m;
  Heading heading;
  friend constexpr bool operator==(const State&, const State&) = default;
};

}  // namespace fairway
