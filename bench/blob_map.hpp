// A map for measurements: organic blobs of obstacles in open space, from a seed, of any size.
//
// Properties that always hold:
//   1. The same side and seed give the same map; blobs have the same size on every side, so that
//      larger maps have more of them, not larger ones.
//   2. About 20 % of the cells are obstacles, and the outermost ring of cells all are.
//   3. No two obstacles touch only at a corner: solvers that step to 4 and to 8 neighbours see the
//      same passages.
// Building one needs little memory besides the map itself.
#pragma once

#include <cstdint>

#include "fairway/base/grid.hpp"
#include "fairway/map/obstacle_map.hpp"

namespace fairway::bench {

/// `side` by `side` cells of 2 m, lower left corner at (0, 0). side >= 32.
[[nodiscard]] ObstacleMap blob_map(int side, std::uint64_t seed);

/// The cell nearest to the map's centre (by the greater of dx, dy) with no obstacle within
/// `clearance_cells`. Throws std::runtime_error when there is none.
[[nodiscard]] Cell open_place(const ObstacleMap& map, int clearance_cells);

}  // namespace fairway::bench
