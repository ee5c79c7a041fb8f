// Warnings that nobody should miss when first looking at a plan: on stderr, in summary.json, and at
// the very top of the page. One or a few sentences each, ending with a full stop.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/simulate/flight_statistics.hpp"

namespace fairway {

/// Share of the free cells that may be cut off before a warning says so.
inline constexpr double most_cut_off_unwarned = 0.1;

/// The warning that more free cells than that are cut off: how many, and what it means for a
/// vehicle there. `remedy`: whole sentences about why, and what would open a way; or nothing.
[[nodiscard]] std::optional<std::string> cut_off_warning(const Plan& plan,
                                                         const std::string& remedy = {});

/// Share of the flights from safe starts with a command that may fail before a warning says so.
inline constexpr double most_failing_unwarned = 0.05;

/// The warning that more of them do. `starts_with_command`: how their flights ended.
[[nodiscard]] std::optional<std::string> failing_warning(const Plan& plan,
                                                         const OutcomeCounts& starts_with_command);

/// Those of the map, then those of the plan made of this scenario on it; of free cells that are cut
/// off, with the passage that is too narrow; of a contract that is too wide.
[[nodiscard]] std::vector<std::string> plan_warnings(const Scenario& scenario,
                                                     const ObstacleMap& map, const Plan& plan);

}  // namespace fairway
