// How a plan came about: what goes into Plan::record_json, and what later commands read from it.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/simulate/flight_files.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// Mission, every effective option, inputs with digests, frame, program version; no times, no
/// machine, no threads. Paths of inputs as the scenario gives them, relative to its folder.
[[nodiscard]] std::string plan_record(const Scenario& scenario, const ObstacleMap& map,
                                      const Mission& mission);

/// The same for a plan made without a scenario.
[[nodiscard]] std::string plan_record(const ObstacleMap& map, const Mission& mission,
                                      const FieldOptions& options);

/// The field becomes a plan; its arrays move.
[[nodiscard]] Plan plan_of_field(Field&& field, const Vehicle& vehicle, std::string record_json);

/// Scenario, map and path files with their digests.
[[nodiscard]] nlohmann::json inputs_json(const Scenario& scenario, const ObstacleMap& map);

/// The reference point of a plan's frame, when its map was in degrees. A plan of other origin has
/// none. Throws InputError{where, ...} when it is there but damaged.
[[nodiscard]] std::optional<GeoReference> georeference_of(const Plan& plan,
                                                          const std::string& where);

/// Where the plan's mission wants the vehicle, and with which heading; none when its goal has no
/// heading, it follows a path, or the plan is of other origin. Throws InputError{where, ...} when
/// it is there but damaged.
[[nodiscard]] std::optional<State> goal_pose_of(const Plan& plan, const std::string& where);

/// Degrees on earth of a point of the frame; empty without a reference point.
[[nodiscard]] LonLatOf lon_lat_of(const std::optional<GeoReference>& georeference);

}  // namespace fairway
