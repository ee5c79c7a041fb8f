// How a set of states may leave a cell: an enclosure of the motion of docs/model.md, one arc of
// the turning radius towards the command, then straight.
//
// Lengths are in cells, and a cell is the square [-1/2, 1/2]^2 about its own centre, so that all
// four sides look alike in their frames (interval.hpp): the side is x = 1/2, and a vehicle that
// turns with sign k (+1 left) about (a, b) on radius R crosses it outwards in exactly one point,
//     heading (sqrt(1 - h^2), h), h = k (1/2 - a) / R, at the place y = b - k R sqrt(1 - h^2).
// A state leaves a cell by the first of these four events, unless it aligns first; all happen
// within 90 degrees of the start, because the chord is at most sqrt(2) < sqrt(2) R, so of two
// events the earlier one has the other's heading on its turning side.
#pragma once

#include <vector>

#include "check/interval.hpp"

namespace fairway_check {

/// A set of states in a closed cell.
struct Bundle {
  Vec at{};
  Vec heading{};  ///< unit vectors
  int turn = 0;   ///< not 0: every state is on a circle of this sign with its centre in `centre`
  Vec centre{};
};

struct Command {
  Vec heading{};
  bool exists = false;    ///< else the cell is crossed straight
  bool is_flown = false;  ///< the states' heading is exactly this command
};

/// The states that may leave by one side.
struct Way {
  int side = 0;
  Real place{};          ///< along the side, in its frame, within [-1/2, 1/2]
  bool at_low = false;   ///< may pass through the corner at -1/2 ...
  bool at_high = false;  ///< ... or at 1/2
  bool skims = false;    ///< may run along the side, straight
  bool aligned = false;  ///< the heading is exactly the command
  Vec heading{};
  int turn = 0;  ///< as in Bundle
  Vec centre{};
  double length = 0.0;  ///< no state has flown farther in the cell
};

/// Adds every way by which a state of `set` may leave. `radius` > 1 cell. False: the set is too
/// large to follow and the ways are meaningless. Needs `Upwards`.
[[nodiscard]] bool find_ways(const Bundle& set, const Command& command, const Real& radius,
                             std::vector<Way>& ways);

}  // namespace fairway_check
