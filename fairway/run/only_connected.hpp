// The part of a map that a mission is about: free ground that is not connected to it is left out.
#pragma once

#include <string>

#include "fairway/map/obstacle_map.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// Makes obstacles of the cells that no chain of free cells with a side in common joins to the
/// goal's cell, or to a cell of the path: the infield of a race track. What is joined has the
/// clearance it had, for the walls between are nearer. Adds a warning with the count; leaves the
/// map unchanged if the mission has no free cell.
void keep_only_connected(ObstacleMap& map, const Mission& mission, const std::string& file);

}  // namespace fairway
