// Puts a scenario's mission on its map: the world that the mission needs, and the mission itself
// once the map, and hence the frame, is known.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// The scenario's map; where the map file bounds no world, the world holds the mission, too (goal,
/// path and states), with room for the vehicle: it keeps clear of the world's border (Assumption 1)
/// wherever it lies.
[[nodiscard]] MapRequest map_request(const Scenario& scenario);

/// An error of the input with what its map warned of: the reason may stand there.
class WarnedInputError : public InputError {
 public:
  WarnedInputError(const std::string& where, const std::string& what,
                   std::vector<std::string> of_map)
      : InputError(where, what), warnings(std::move(of_map)) {}
  std::vector<std::string> warnings;
};

/// Reads the path file, or lays the goal on the map's plane. Throws WarnedInputError naming the
/// scenario's line, and the path file's.
[[nodiscard]] Mission mission_on_map(const Scenario& scenario, const ObstacleMap& map);

/// The key of the scenario that says where to: "mission.goal_m", ...
[[nodiscard]] const char* place_key(const Scenario& scenario);

/// The refusal's message, its places in degrees where the scenario gave its goal in degrees.
[[nodiscard]] std::string refusal_words(const Scenario& scenario, const Frame& frame,
                                        const MissionRefusal& refusal);

/// A refusal that is the input's fault (not Reason::unreachable) as an InputError at the key of the
/// scenario that asked for it. `frame`: of the map.
[[noreturn]] void throw_refusal(const Scenario& scenario, const Frame& frame,
                                const MissionRefusal& refusal);

}  // namespace fairway
