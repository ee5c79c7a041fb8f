// A feedback plan: for every cell the heading to steer (the contract's model section).
//
// Properties that always hold: the three arrays have grid.size() entries, [iy][ix]; a heading is
// in (-pi, pi] or NaN (no command: crossed straight); cost_m is >= 0 or +inf (unreachable); the
// heading is a number wherever cost_m is finite and the cell is not an obstacle.
#pragma once

#include <string>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/map/region.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

struct Plan {
  Grid grid;
  Vehicle vehicle;
  std::vector<float> heading_rad;  ///< [iy][ix]
  std::vector<Region> region;      ///< [iy][ix]
  std::vector<float> cost_m;       ///< [iy][ix]
  /// How it came about, one JSON object: mission, every effective option, inputs, frame.
  std::string record_json = "{}";
};

}  // namespace fairway
