// The paper's experiment on the project's own map: vehicle, map, the two missions, and plans for
// them with any parameters.
#pragma once

#include <filesystem>
#include <string>

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway::reproduce {

struct World {
  ObstacleMap map;
  Vehicle vehicle;
  Mission mission;
  State start;  ///< the first of the scenario's states
};

/// The scenario's world with cells of `cell_m` instead of its own.
[[nodiscard]] World world_of(const std::filesystem::path& scenario, double cell_m);

/// The plan, or std::runtime_error with the reason of a refusal: the shipped missions have none.
[[nodiscard]] Plan plan_in(const World& world, const FieldOptions& options);

/// The field after each step of paper 1, Fig. 2, as plans, so that they can be drawn.
struct FieldSteps {
  Plan complete_map;  ///< no commands
  Plan raw;
  Plan transitions;
  Plan smoothed;
};
[[nodiscard]] FieldSteps steps_in(const World& world, const FieldOptions& options);

}  // namespace fairway::reproduce
