// The outer border of the buffer: the safe-start cells, only reachable ones, that touch it, and for
// every cell the nearest of them (paper 1: "the closest point of the buffer region's external
// border"). A border cell that cannot reach the goal is not a way out, so it is excluded.
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
