// The states that plans are compared in: those in cells that are neither obstacle nor goal in any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/compare/compared_plan.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

struct CommonGround {
  Grid grid;                  ///< that of the smallest cells; the order of the plans is no matter
  std::vector<bool> cells;    ///< [iy][ix], where states are drawn
  std::vector<State> states;  ///< in pairs, as stratified_states() draws them
  std::vector<bool> counts;   ///< [state]: on the ground of every plan; empty: all are
  std::size_t counted = 0;    ///< how many do

  bool is_counted(std::size_t state) const { return counts.empty() || counts[state]; }
};

/// Whether the state is in a free or a buffer cell of the plan.
[[nodiscard]] bool is_on_ground(const Plan& plan, Vec2 place_m);

[[nodiscard]] CommonGround common_ground(std::span<const ComparedPlan> plans, std::size_t strata,
                                         std::uint64_t seed);

}  // namespace fairway
