// A behaviour as text: what was flown, and which command of which place justified it
// (docs/formats.md).
#pragma once

#include <span>
#include <string>

#include "fairway/behaviour/behaviour_flight.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/verify/flow.hpp"

namespace fairway {

/// `time_s,x_m,y_m,heading_rad,curvature_per_m,radius_m,command_rad,command_x_m,command_y_m`: a
/// line at the start of each step, with what holds during the step, and a last one at the end,
/// whose last five columns are empty. The curvature is positive to the left; radius_m is empty on
/// straight steps. The command in force, error included, is one of the place (command_x_m,
/// command_y_m). Flown at the vehicle's nominal speed. `commands`: filled_commands of the flow.
[[nodiscard]] std::string witness_csv(const Flow& flow, std::span<const float> commands,
                                      const VehicleContract& contract,
                                      const BehaviourFlight& flight);

}  // namespace fairway
