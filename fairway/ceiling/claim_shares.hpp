// How much of the states of cells and bins claims hold of.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/ceiling/ceiling_level.hpp"

namespace fairway {

/// [cell_bins]: of four places for each node, the share that a claim holds of. 0 in obstacles and
/// in the goal.
[[nodiscard]] std::vector<float> claimed_shares(const BallLattice& lattice,
                                                const CeilingCells& cells,
                                                const std::vector<Radius>& claims);

/// [cell_bins]: 1 where one of the claims holds of all places of the cell, or none is asked for.
[[nodiscard]] std::vector<std::uint8_t> closed_cell_bins(const BallLattice& lattice,
                                                         const CeilingCells& cells,
                                                         const std::vector<Radius>& inside,
                                                         const std::vector<Radius>& lost);

}  // namespace fairway
