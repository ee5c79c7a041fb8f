// What a scenario asks for, laid on its map: the world that the mission needs, and the mission once
// the map and so the frame is known.
#pragma once

#include "fairway/map/obstacle_map.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// The scenario's map, with room for its vehicle where the map file bounds no world: a mission that
/// the file names keeps clear of the world's border (Assumption 1) wherever it lies.
[[nodiscard]] MapRequest map_request(const Scenario& scenario);

/// Reads the path file, or lays the goal on the map's plane. Throws InputError naming the
/// scenario's line, or the path file's.
[[nodiscard]] Mission mission_on_map(const Scenario& scenario, const ObstacleMap& map);

/// The key of the scenario that says where to: "mission.goal_m", ...
[[nodiscard]] const char* place_key(const Scenario& scenario);

/// A refusal that is the input's fault (not Reason::unreachable) as an InputError at the key of the
/// scenario that asked for it.
[[noreturn]] void throw_refusal(const Scenario& scenario, const MissionRefusal& refusal);

}  // namespace fairway
