// How a plan was made: the record of a plan made from a scenario, or from data in memory.
#pragma once

#include <vector>

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan_record.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// Scenario, map and path files with their digests, as the record of a plan has them.
[[nodiscard]] std::vector<InputFile> recorded_inputs(const Scenario& scenario,
                                                     const ObstacleMap& map);

/// Mission, every effective option, inputs with digests, frame, program version; no times, no
/// machine, no threads. Paths of inputs as the scenario gives them, relative to its folder.
[[nodiscard]] PlanRecord plan_record(const Scenario& scenario, const ObstacleMap& map,
                                     const Mission& mission);

/// The same for a plan made without a scenario.
[[nodiscard]] PlanRecord plan_record(const ObstacleMap& map, const Mission& mission,
                                     const FieldOptions& options);

}  // namespace fairway
