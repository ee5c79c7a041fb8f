// The field stage in one call: complete map, cost-to-go, raw field, transitions, filter
// (paper 1, Fig. 2). Each step has its own header next to this one.
#pragma once

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Throws PreconditionViolation when vehicle, mission or options are out of range or not finite;
/// readers check them beforehand. A mission that the map does not allow is a MissionRefusal.
[[nodiscard]] FieldOrRefusal compute_field(const ObstacleMap& map, const Vehicle& vehicle,
                                           const Mission& mission, const FieldOptions& options);

}  // namespace fairway
