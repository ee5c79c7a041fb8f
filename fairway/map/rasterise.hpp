// Conservative rasterising: from pixels or fences to the grid of plan cells.
//
// Properties that always hold:
//   1. Pixels: a cell is an obstacle if the interior of an obstacle pixel overlaps the cell's
//      interior, or, with growth R > 0, if the distance between the two squares is less than R
//      (Euclidean, exact up to `pixel_slack` of a pixel). Equal cells and pixels: the image itself.
//   2. Fences: a cell is an obstacle if the closed square and the closed obstacle set (keep-out
//      areas, and everything that is not strictly inside the keep-in set) are at most R apart.
//      `cell_slack` of a cell is added outwards, so that rounding never frees a cell.
//   3. The grid starts at the map's lower-left corner and has ceil(width / cell_m) columns; with
//      `outside_is_obstacle` the world beyond the map is an obstacle too, grown like any other,
//      and a ring of obstacle cells surrounds the grid (the origin moves by -cell_m).
// Cost: linear in pixels plus cells, or in cells plus rows crossed by edges; independent of R.
#pragma once

#include <cstdint>

#include "fairway/map/fence_set.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/map/source_raster.hpp"

namespace fairway {

inline constexpr double pixel_slack = 1e-9;
inline constexpr double cell_slack = 1e-9;

struct RasteriseOptions {
  double cell_m = 1.0;    ///< > 0
  double growth_m = 0.0;  ///< >= 0, the radius R
  bool unknown_is_obstacle = true;
  bool outside_is_obstacle = true;
  double least_world_margin_m = 0.0;  ///< >= 0, lower bound of the default margin; fences only
  std::uint64_t max_cells = std::uint64_t{1} << 28;
};

/// Throws InputError{"map.cell_m", ...} when the grid would have more than max_cells cells.
[[nodiscard]] ObstacleMap rasterise(const SourceRaster& source, const RasteriseOptions& options);

/// `inclusion` is required with several keep-in fences; `world_margin_m` (default: see MapRequest)
/// applies without one. Throws InputError as above, and when nothing bounds the world.
[[nodiscard]] ObstacleMap rasterise(const FenceSet& fences, const RasteriseOptions& options,
                                    Inclusion inclusion, std::optional<double> world_margin_m);

}  // namespace fairway
