// A contract that allows so much that nothing can be proved of the plan: known from the plan alone,
// before any proof.
#pragma once

#include <optional>
#include <string>

#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway {

/// Share of the cells, neither obstacle nor goal, at whose middle the contract allows commands so
/// far apart (half a turn, for most contracts) that a vehicle may turn either way: of parts so
/// small as to be points, those that are wild (inclusion/parts.hpp). Measured on at most 2,000
/// cells, commands to the degree.
[[nodiscard]] double wild_share(const Plan& plan, const VehicleContract& contract);

/// Share that may be wild before a warning says so.
inline constexpr double most_wild_unwarned = 0.1;

/// Whether all are: then hardly anything can be proved, and the work is not worth beginning.
[[nodiscard]] bool is_wild_everywhere(const Plan& plan, const VehicleContract& contract);

/// The warning that more are, with the command error that leaves hardly any.
[[nodiscard]] std::optional<std::string> contract_warning(const Plan& plan,
                                                          const VehicleContract& contract);

}  // namespace fairway
