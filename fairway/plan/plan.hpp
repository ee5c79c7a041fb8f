// A feedback plan: for every cell the heading to steer (docs/model.md).
//
// Properties that always hold: the arrays have grid.size() entries, [iy][ix], those of further
// modes as many for each mode, and the record says how each was made; a heading is in (-pi, pi] or
// NaN (no command: crossed straight); cost_m is >= 0 or +inf (unreachable); the heading is a number
// wherever cost_m is finite and the cell is not an obstacle; a goal with a heading lies on the
// grid.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
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
  /// Commands of further modes (docs/modes.md), [mode - 1][iy][ix]; a heading or NaN. Empty: the
  /// plan has one mode, as in the papers.
  std::vector<float> mode_heading_rad;
  PlanRecord record;

  std::size_t further_modes() const {
    return grid.size() == 0 ? 0 : mode_heading_rad.size() / grid.size();
  }
  /// The commands of each further mode, [iy][ix].
  std::vector<const float*> further_rad() const {
    std::vector<const float*> modes;
    for (std::size_t k = 0; k < further_modes(); ++k) {
      modes.push_back(mode_heading_rad.data() + k * grid.size());
    }
    return modes;
  }
};

/// 1 for the cells out of the mission's reach, [iy][ix], if the plan has holding places there; else
/// empty.
[[nodiscard]] inline std::vector<std::uint8_t> holding_cells(const Plan& plan) {
  if (plan.record.holding_places.empty()) return {};
  std::vector<std::uint8_t> holding(plan.grid.size());
  for (std::size_t i = 0; i < holding.size(); ++i) {
    const bool holds = plan.region[i] != Region::obstacle && !std::isfinite(plan.cost_m[i]);
    holding[i] = holds ? 1 : 0;
  }
  return holding;
}

/// Where the plan's mission sends the vehicle, and with which heading; none when its goal has no
/// heading, it follows a path, or the plan was not made by Fairway.
[[nodiscard]] inline std::optional<State> goal_pose_of(const Plan& plan) {
  if (!plan.record.mission) return {};
  const auto* goal = std::get_if<GoalMission>(&*plan.record.mission);
  if (goal == nullptr || !goal->goal_heading_rad) return {};
  return State{goal->goal_m, Heading::from_rad(*goal->goal_heading_rad)};
}

}  // namespace fairway
