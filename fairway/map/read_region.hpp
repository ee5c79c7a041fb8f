// Reads which cells of a grid are of interest: areas in GeoJSON, or CSV of cells.
//
// GeoJSON: Polygons and MultiPolygons, bare or in features; [longitude, latitude] on a grid that
// has a place on Earth, else [x_m, y_m] in the grid's frame. A cell belongs when all of it, border
// included, lies in one of the areas; an area's border within 1e-9 of a cell of a grid line lies on
// it. CSV: a cell a line, ix,iy.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "fairway/base/frame.hpp"
#include "fairway/base/grid.hpp"

namespace fairway {

/// [iy][ix], 1 for the cells that belong. Throws InputError naming the place in the file for what
/// cannot be read, areas whose rings cross themselves, and cells outside the grid; and when no cell
/// belongs.
[[nodiscard]] std::vector<std::uint8_t> read_region(const std::filesystem::path& file,
                                                    const Grid& grid, const Frame& frame);

}  // namespace fairway
