// The region of interest of the paper's method, as cells [iy][ix]: not 0 for cells that belong to
// it. It takes the place of the goal.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/plan/plan.hpp"

namespace fairway {

/// The plan's cells of one kind: Region::goal, or Region::obstacle to ask what collides.
[[nodiscard]] std::vector<std::uint8_t> cells_of(const Plan& plan, Region kind);

/// The cells that lie wholly inside a closed rectangle, opposite corners in any order. Obstacle
/// cells too.
[[nodiscard]] std::vector<std::uint8_t> cells_inside(const Grid& grid, Vec2 corner_m,
                                                     Vec2 opposite_m);

}  // namespace fairway
