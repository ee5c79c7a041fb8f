// The outer border of the buffer: the safe-start cells, reachable ones only, that touch it, and for
// every cell the nearest of them (paper 1: "the closest point of the buffer region's external
// border"). A border cell from which the goal cannot be reached is no way out, so it is left out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/field/complete_map.hpp"

namespace fairway {

struct BufferBorder {
  std::vector<std::uint32_t> nearest;  ///< [iy][ix] flat index of a border cell, or no_feature
};

/// `cost_cells` is the safe-start cost, +inf elsewhere. Distances are straight, through anything.
[[nodiscard]] BufferBorder buffer_border(const Grid& grid, const std::vector<Region>& region,
                                         std::span<const float> cost_cells);

}  // namespace fairway
