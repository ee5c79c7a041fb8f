// Warnings about parameters and paths that the vehicle or the method cannot handle well, issued
// before anything is planned.
#pragma once

#include <string>
#include <vector>

#include "fairway/run/scenario.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// One line each, with the scenario's file and line: parameters that the scenario sets outside the
/// range paper 1 gives (a transition's width of 0, which is none, aside), and what the vehicle
/// cannot fly of a path (vehicle/path_troubles.hpp).
[[nodiscard]] std::vector<std::string> design_warnings(const Scenario& scenario,
                                                       const Mission& mission);

}  // namespace fairway
