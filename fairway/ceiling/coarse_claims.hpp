// From the claims of one level to the next.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/ceiling/ceiling_level.hpp"

namespace fairway {

/// Raises `fine` to what `claims` of the coarse level say.
void add_coarse_claims(const CeilingLevel& coarse, const std::vector<Radius>& claims,
                       const BallLattice& lattice, std::vector<Radius>& fine);

/// The tiles that hold cells and bins of which the coarse level leaves something open, and those
/// next to them. Without a coarse level all.
[[nodiscard]] std::vector<std::uint32_t> open_tiles(const BallLattice& lattice,
                                                    const CeilingCells& cells,
                                                    const CeilingLevel* coarse);

}  // namespace fairway
