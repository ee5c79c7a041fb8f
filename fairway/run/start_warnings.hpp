// Warnings about starts that are probably mistakes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fairway/base/frame.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// A sentence when starts lie in obstacles: they collide at once. Of starts that a scenario gives.
[[nodiscard]] std::vector<std::string> obstacle_warnings(std::span<const State> starts,
                                                         const Plan& plan);

/// A sentence when a start in metres has the numbers of the map's own latitude and longitude, or of
/// its longitude and latitude, to half a degree. None where the frame is not georeferenced.
[[nodiscard]] std::vector<std::string> degree_warnings(std::span<const State> starts,
                                                       const Grid& grid, const Frame& frame);

/// Both, of starts that a scenario gives for this plan.
[[nodiscard]] std::vector<std::string> start_warnings(std::span<const State> starts,
                                                      const Plan& plan);

}  // namespace fairway
