// The input files of a run, and a check that it does not overwrite them.
#pragma once

#include <filesystem>
#include <vector>

#include "fairway/map/obstacle_map.hpp"
#include "fairway/run/scenario.hpp"

namespace fairway {

/// The files that the scenario names, including itself.
[[nodiscard]] std::vector<std::filesystem::path> inputs_of(const Scenario& scenario);

/// The files that the map file names in turn.
[[nodiscard]] std::vector<std::filesystem::path> inputs_of(const ObstacleMap& map);

/// Throws InputError when a product would overwrite one of its inputs.
void require_no_inputs(const std::vector<std::filesystem::path>& products,
                       const std::vector<std::filesystem::path>& inputs);

}  // namespace fairway
