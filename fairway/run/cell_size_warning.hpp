// Whether finer cells would open ground that coarse ones close: a cell that an obstacle touches is
// an obstacle, so passages narrower than two or three cells vanish.
#pragma once

#include <optional>
#include <string>

#include "fairway/map/obstacle_map.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// A sentence with the scenario's line, where cells are coarser than 0.4 turning radii and cells of
/// half the size join a tenth more ground to the mission. Cost: that of reading the map again, only
/// for such cells. `map` as read, with the mission on it.
[[nodiscard]] std::optional<std::string> cell_size_warning(const Scenario& scenario,
                                                           const ObstacleMap& map,
                                                           const Mission& mission);

}  // namespace fairway
