// What a run is made of, and that it does not write over it.
#pragma once

#include <filesystem>
#include <vector>

#include "fairway/map/obstacle_map.hpp"
#include "fairway/run/scenario.hpp"

namespace fairway {

/// The files that the scenario names, itself among them.
[[nodiscard]] std::vector<std::filesystem::path> inputs_of(const Scenario& scenario);

/// What the map's file names in turn.
[[nodiscard]] std::vector<std::filesystem::path> inputs_of(const ObstacleMap& map);

/// Throws InputError when a product would take the place of what it is made of.
void require_no_inputs(const std::vector<std::filesystem::path>& products,
                       const std::vector<std::filesystem::path>& inputs);

}  // namespace fairway
