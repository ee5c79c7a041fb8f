// A plan from what is already in memory, instead of a scenario's files.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// map -> field -> plan; the plan's record holds mission, options and frame, and for inputs those
/// of the map. Throws ContractViolation as compute_field does.
[[nodiscard]] std::variant<Plan, MissionRefusal> plan_map(const ObstacleMap& map,
                                                          const Vehicle& vehicle,
                                                          const Mission& mission,
                                                          const FieldOptions& options);

/// The mission in a plan's record; none when the plan is of other origin. Throws
/// InputError{where, ...} when it is there but damaged.
[[nodiscard]] std::optional<Mission> mission_of(const Plan& plan, const std::string& where);

}  // namespace fairway
