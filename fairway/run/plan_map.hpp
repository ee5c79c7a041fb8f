// A plan from what is already in memory, instead of a scenario's files.
#pragma once

#include <variant>

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// map -> field -> plan; the plan's record holds mission, options and frame, and for inputs those
/// of the map. Throws PreconditionViolation as compute_field does.
[[nodiscard]] std::variant<Plan, MissionRefusal> plan_map(const ObstacleMap& map,
                                                          const Vehicle& vehicle,
                                                          const Mission& mission,
                                                          const FieldOptions& options);

}  // namespace fairway
