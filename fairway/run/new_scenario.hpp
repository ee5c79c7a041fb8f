// A first scenario for a map, ready to run: cells, turning radius and goal are chosen so that the
// goal can be reached from most of the map, and every choice has a comment.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "fairway/map/read_map.hpp"
#include "fairway/run/scenario.hpp"

namespace fairway {

/// What the user has given; the rest is chosen.
struct NewScenarioRequest {
  MapRequest map;                ///< cell_m is not used
  std::filesystem::path output;  ///< where the scenario will lie: its map file is named from there
  std::optional<double> cell_m;
  std::optional<double> turn_radius_m;
  std::optional<double> speed_mps;
};

struct NewScenario {
  std::string text;     ///< TOML
  Scenario scenario;    ///< the same, read
  double serves = 0.0;  ///< share of the free cells that are connected to the goal
};

/// The largest radius of a few whose free cells, those of the goal's part alone, are nearly as many
/// as with the best of them; the goal lies in the largest part that one fits in, where the
/// clearance is largest. It has been planned once. Throws InputError when no goal fits, with a
/// remedy.
[[nodiscard]] NewScenario new_scenario(const NewScenarioRequest& request);

}  // namespace fairway
