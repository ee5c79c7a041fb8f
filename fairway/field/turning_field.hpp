// A field that leads to places where the vehicle can turn: cells from which the plan brings it
// whichever way it faces (docs/modes.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/map/region.hpp"

namespace fairway {

/// Commands, [iy][ix], along the shortest ways to the cells of `places` ([iy][ix], nonzero); NaN in
/// obstacle cells, in those places, and where none can be reached. Commands bend away from walls
/// within `reach_m`.
[[nodiscard]] std::vector<float> turning_field(const Grid& grid, const std::vector<Region>& region,
                                               std::span<const std::uint8_t> places,
                                               double reach_m);

}  // namespace fairway
