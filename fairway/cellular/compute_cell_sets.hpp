// A cell's command -> its tabulated sets.
#pragma once

#include "fairway/cellular/cell_sets.hpp"

namespace fairway {

/// `places` along each border, at least 1. Throws PreconditionViolation when there are fewer or the
/// cell is not smaller than the turning radius.
[[nodiscard]] CellSets compute_cell_sets(const Direction& command, const CellShape& shape,
                                         int places);

}  // namespace fairway
