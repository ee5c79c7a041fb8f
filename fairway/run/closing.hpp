// How a run ends: its findings, its warnings, what they are based on, and the same in prose.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/scenario_flights.hpp"
#include "fairway/run/verified.hpp"

namespace fairway {

[[nodiscard]] std::vector<Finding> findings_of(const Plan& plan, const ScenarioFlights& flown,
                                               const Verified& verified);

/// Those of the map, of the plan, of its flights, of the scenario's own starts, and of a proof that
/// a limit ended.
[[nodiscard]] std::vector<std::string> warnings_of(const Scenario& scenario, const ObstacleMap& map,
                                                   const Plan& plan, const ScenarioFlights& flown,
                                                   const Verified& verified);

/// Lines below the findings, each ending with a newline: what they mean and assume, who checked
/// the proof, last legs, the grid.
[[nodiscard]] std::string notes_of(const Plan& plan, const ScenarioFlights& flown,
                                   const Verified& verified);

/// What was proved, and what was assumed, in prose.
[[nodiscard]] std::string words_of(const Verified& verified);

/// The member `verify` of summary.json.
[[nodiscard]] nlohmann::json json_of(const Verified& verified);

}  // namespace fairway
