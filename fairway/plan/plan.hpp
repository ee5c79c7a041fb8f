// A feedback plan: for every cell the heading to steer (docs/model.md).
//
// Properties that always hold: the three arrays have grid.size() entries, [iy][ix]; a heading is
// in (-pi, pi] or NaN (no command: crossed straight); cost_m is >= 0 or +inf (unreachable); the
// heading is a number wherever cost_m is finite and the cell is not an obstacle; a goal with a
// heading lies on the grid.
#pragma once

#include <optional>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/map/region.hpp"
#include "fairway/plan/plan_record.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

struct Plan {
  Grid grid;
  Vehicle vehicle;
  std::vector<float> heading_rad;  ///< [iy][ix]
  std::vector<Region> region;      ///< [iy][ix]
  std::vector<float> cost_m;       ///< [iy][ix]
  PlanRecord record;
};

/// Where the plan's mission sends the vehicle, and with which heading; none when its goal has no
/// heading, it follows a path, or the plan was not made by Fairway.
[[nodiscard]] inline std::optional<State> goal_pose_of(const Plan& plan) {
  if (!plan.record.mission) return {};
  const auto* goal = std::get_if<GoalMission>(&*plan.record.mission);
  if (goal == nullptr || !goal->goal_heading_rad) return {};
  return State{goal->goal_m, Heading::from_rad(*goal->goal_heading_rad)};
}

}  // namespace fairway
