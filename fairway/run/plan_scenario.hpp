// map -> field -> plan: the first steps of every run.
#pragma once

#include <variant>
#include <vector>

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/choose_parameters.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

struct Planned {
  ObstacleMap map;
  Mission mission;
  Plan plan;
  Scenario scenario;  ///< as it was asked for, with the parameters that were chosen
  std::vector<TriedParameters> tried;  ///< from which; empty: nothing was left open
};

/// In memory. A refusal is `unreachable`; any
/// other problem with the mission is an InputError at the scenario's line.
[[nodiscard]] std::variant<Planned, MissionRefusal> plan_scenario(const Scenario& scenario,
                                                                  StageClock& clock);

}  // namespace fairway
