// The complete map (paper 1, Algorithm 1): obstacles, buffer, safe start and goal of a mission.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "fairway/field/field.hpp"
#include "fairway/field/mission_cells.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

struct CompleteMap {
  std::vector<Region> region;                  ///< [iy][ix]
  std::vector<std::int32_t> clearance_cells2;  ///< squared distance to the nearest obstacle cell,
                                               ///< centre to centre, in cells; [iy][ix]
  std::vector<std::uint32_t> goal_cells;       ///< region goal, ascending flat indices
  std::vector<PathCell> path_cells;  ///< path missions: the same cells with their tangents
};

/// A cell is buffer if its centre is within alpha * r of the centre of an obstacle cell (Eq. 3);
/// with Metric::paper if Algorithm 1's wave reaches it in ceil(alpha r / cell) sweeps (a square
/// dilation, up to sqrt(2) wider on diagonals, never narrower). Assumption 1 is checked.
[[nodiscard]] std::variant<CompleteMap, MissionRefusal> complete_map(const ObstacleMap& map,
                                                                     const Vehicle& vehicle,
                                                                     const Mission& mission,
                                                                     const FieldOptions& options);

}  // namespace fairway
