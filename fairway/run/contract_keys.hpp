// The keys of [vehicle.contract].
#pragma once

#include <vector>

#include "fairway/run/scenario_keys.hpp"

namespace fairway {

inline constexpr const char* contract_table = "vehicle.contract";

/// A key that is given makes a contract; what it lacks is that of the exact vehicle.
[[nodiscard]] std::vector<ScenarioKey> contract_keys();

/// Ranges that a contract does not name hold the vehicle's own radius and speed alone.
void complete_contract(Scenario& scenario);

}  // namespace fairway
