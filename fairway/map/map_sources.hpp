// The readers of pixel maps, one file each; read_map chooses among them.
#pragma once

#include "fairway/map/read_map.hpp"
#include "fairway/map/source_raster.hpp"
#include "fairway/map/source_text.hpp"

namespace fairway {

/// ROS map_server YAML with its image (ros_map.cpp).
[[nodiscard]] SourceRaster read_ros_map(const SourceText& yaml, const MapRequest& request);

/// MovingAI .map (moving_ai.cpp).
[[nodiscard]] SourceRaster read_moving_ai(const SourceText& source, const MapRequest& request);

/// Images placed by geotransform, world file or resolution_m; elevations with altitude_m
/// (placed_raster.cpp).
[[nodiscard]] SourceRaster read_placed_raster(const MapRequest& request);

/// request.resolution_m for a file without a scale. Throws InputError when it is missing.
[[nodiscard]] double required_resolution_m(const MapRequest& request);

/// Throws InputError when request.resolution_m contradicts the file's own `pixel_m`.
void require_agreeing_resolution(const MapRequest& request, double pixel_m);

}  // namespace fairway
