// The search for the highest value of a function over ranges: all over the box first, then around
// the best.
//
// The share of states that a plan saves jumps where a passage closes, and is level in between, for
// a buffer is whole cells wide. So the first part is DIRECT (Jones and others 1993), which divides
// the box, needs neither slopes nor continuity, and has no draws. Its variant DIRECT-L looks near
// the best so far earlier, and took twice as long to find a narrow step. The second part is a
// subplex (Rowan 1990), a simplex, which does without slopes, too. Both are NLopt's.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace fairway {

/// The value at a place in the unit box; nothing ends the search.
using Sought = std::function<std::optional<double>(std::span<const double> place)>;

/// Asks `sought` at most `evaluations` times. Its places depend on what it has answered alone.
/// `start`: where the second part begins unless the first found better.
void search_box(std::span<const double> start, int evaluations, const Sought& sought);

}  // namespace fairway
