// Algorithm 1 of paper 2, the iterative border expansion: the reference for bitmap_backward.hpp.
//
// Sweeps over all borders, each updated from its neighbours, until a sweep adds nothing. The
// neighbours of a border are eight: the three other borders of the cell on either side, and itself
// through either cell, since a shallow arc can leave by the border it came in by. (The paper counts
// six.) Cost: as many sweeps as the longest path in sample states, each over every state, and four
// bytes a state for the relation: for tests and small plans.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/bitmap/bitmap_backward.hpp"
#include "fairway/bitmap/border_bitmap.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway {

struct BitmapExpansion {
  BorderBitmap set;
  int sweeps = 0;  ///< the last one adds nothing
};

/// Arguments and errors as backward_reachable_set; additionally throws PreconditionViolation from
/// 2^31 states on.
[[nodiscard]] BitmapExpansion expand_borders(const Plan& plan,
                                             const std::vector<std::uint8_t>& target_cells,
                                             const BitmapOptions& options = {});

}  // namespace fairway
