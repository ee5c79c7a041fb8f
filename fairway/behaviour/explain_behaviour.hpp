// What justifies each step of a behaviour within a contract.
#pragma once

#include <span>

#include "fairway/behaviour/behaviour_flight.hpp"
#include "fairway/behaviour/explained_behaviour.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/verify/flow.hpp"

namespace fairway {

/// A step for each of the flight's. `commands`: filled_commands of the flow.
[[nodiscard]] ExplainedBehaviour explained(const Flow& flow, std::span<const float> commands,
                                           const VehicleContract& contract,
                                           const BehaviourFlight& flight);

}  // namespace fairway
