// A field that goes on in one direction and bends along walls: for a vehicle that cannot turn where
// it is, but can once it has gone on (docs/modes.md).
#pragma once

#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/map/region.hpp"

namespace fairway {

/// Commands, [iy][ix]; NaN in obstacle cells. `reach_m`: how far from walls commands bend.
[[nodiscard]] std::vector<float> direction_field(const Grid& grid,
                                                 const std::vector<Region>& region,
                                                 double direction_rad, double reach_m);

}  // namespace fairway
