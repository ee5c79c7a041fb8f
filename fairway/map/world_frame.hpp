// The grid over a map's rectangle, and the effect of the world beyond it on the cells.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/map/rasterise.hpp"

namespace fairway {

/// The map's rectangle, metres.
struct MapExtent {
  Vec2 lower_left_m;
  double width_m = 0.0;
  double height_m = 0.0;
};

/// The cells over the extent, without the ring. Throws InputError when there are too many
/// (counting the ring) or none.
[[nodiscard]] Grid grid_over(const MapExtent& extent, const RasteriseOptions& options);

/// With options.outside_is_obstacle: marks the cells of `inner` touched by the grown world beyond
/// the extent, and adds the ring around. Returns the finished grid; `cells` is [iy][ix].
[[nodiscard]] Grid close_world(const Grid& inner, const MapExtent& extent,
                               const RasteriseOptions& options, std::vector<std::uint8_t>& cells);

}  // namespace fairway
