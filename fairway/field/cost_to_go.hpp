// The cost map (paper 1, Algorithm 2): how far every safe-start cell is from the goal, through
// safe-start cells only.
#pragma once

#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/field/complete_map.hpp"
#include "fairway/field/field.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// Cost in cells, [iy][ix]; +inf for obstacles, buffer and cells that cannot reach the goal.
/// Goal missions measure from the goal point, path missions from the path. Metric::euclidean starts
/// from exact distances in the mission's cells and solves the eikonal equation outwards;
/// Metric::octile and Metric::paper measure from the goal's cell, or from all path cells, as 0
/// (Algorithm 2's numbers minus 2).
[[nodiscard]] std::vector<float> cost_to_go(const Grid& grid, const CompleteMap& complete,
                                            const Mission& mission, Metric metric);

}  // namespace fairway
