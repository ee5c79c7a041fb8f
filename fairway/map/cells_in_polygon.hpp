// The cells that lie wholly in a polygon.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/map/fence_set.hpp"

namespace fairway {

/// Marks in `cells`, [iy][ix], every cell of which all points, those of its border included, lie in
/// the closed polygon. Vertices nearer to a grid line than 1e-9 of a cell lie on it. Cost: cells of
/// the grid plus rows crossed by edges.
void mark_cells_in(const FencePolygon& polygon, const Grid& grid, std::vector<std::uint8_t>& cells);

}  // namespace fairway
