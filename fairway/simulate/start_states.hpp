// Random starts, uniform over a part of the configuration space: cells, position in the cell,
// heading.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/plan/plan.hpp"

namespace fairway {

enum class StartRegion {
  safe_start,   ///< free cells from which the goal can be reached (finite cost)
  flyable,      ///< free and buffer cells: neither obstacle nor goal, whatever their cost
  not_obstacle  ///< the same and goal cells
};

/// State i depends on the plan, `seed` and i alone, so a longer list begins with a shorter one.
/// Empty when the plan has no such cell. Time and memory: one pass and 8 bytes a cell.
[[nodiscard]] std::vector<State> random_states(const Plan& plan, StartRegion where,
                                               std::size_t count, std::uint64_t seed);

}  // namespace fairway
