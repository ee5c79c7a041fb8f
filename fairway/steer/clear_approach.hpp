// A last leg to a pose that touches no obstacle: tests the path itself against closed squares, not
// samples of it.
//
// Properties that always hold:
//   1. A path called clear touches no blocked cell: every cell that the parts' boxes meet is
//   tested,
//      arcs against the square's sides and corners in closed form. Squares are grown by a 2^-30th
//      of a cell and of the radius and a 2^-48th of the coordinates, more than all rounding; so a
//      path that passes an obstacle by less than that counts as touching.
//   2. The approach returned is the shortest of the clear candidates.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "fairway/base/grid.hpp"
#include "fairway/steer/dubins_words.hpp"

namespace fairway {

/// Cells [iy][ix], not 0 where blocked.
struct BlockedCells {
  Grid grid;
  std::span<const std::uint8_t> blocked;
  bool outside_blocked = true;  ///< the world beyond the grid
};

/// Whether no part of the path touches a blocked cell.
[[nodiscard]] bool is_clear(const DubinsPath& path, const BlockedCells& cells);

/// First one turn or straight part, which may be empty, then a path of one word.
struct Approach {
  DubinsPath lead;
  DubinsPath path;
  double length_m() const { return lead.length_m() + path.length_m(); }
};

/// The shortest clear approach among: each of the six words from `from`; and each of them after a
/// turn to either side by a multiple of 45 degrees, up to a whole loiter circle, or after straight
/// on by up to four radii. None when all of them touch. Throws PreconditionViolation unless
/// can_steer().
[[nodiscard]] std::optional<Approach> first_clear_approach(const State& from, const State& goal,
                                                           double turn_radius_m,
                                                           const BlockedCells& cells);

}  // namespace fairway
