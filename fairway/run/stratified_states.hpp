// Random states spread evenly over a part of the configuration space: two in each of many strata of
// equal volume, so that an estimate knows its error (estimate_of_pairs.hpp), and the error is
// smaller than that of states drawn without strata.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// 2 * `strata` states in the cells of `ground`, [iy][ix]; 2 k and 2 k + 1 belong to one stratum: a
/// run of cells (or a part of one) in the order of a Z curve, all headings. Positions and headings
/// are uniform over the ground. They depend on the arguments alone. Empty when the ground is.
[[nodiscard]] std::vector<State> stratified_states(const Grid& grid,
                                                   const std::vector<bool>& ground,
                                                   std::size_t strata, std::uint64_t seed);

}  // namespace fairway
