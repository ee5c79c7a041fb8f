// Directions that bend along walls: what fields of further modes have in common.
#pragma once

#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/field/vector_field.hpp"
#include "fairway/map/region.hpp"

namespace fairway {

/// Within `reach_m` of an obstacle cell, a direction is pushed away from it, the more the nearer:
/// by 1.8 of its own length at the wall, so that it runs along walls that it meets at an angle.
/// Then neighbours are averaged, never through a wall. Commands, [iy][ix]; NaN in obstacle cells
/// and where there is no direction. `onwards`: unit vectors, or (0, 0) for none.
[[nodiscard]] std::vector<float> bent_along_walls(const Grid& grid,
                                                  const std::vector<Region>& region,
                                                  const VectorField& onwards, double reach_m);

}  // namespace fairway
