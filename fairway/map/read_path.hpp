// Reads the line that a path mission follows: CSV, GeoJSON LineString, QGC WPL 110 or a .plan.
//
// CSV: columns x_m and y_m by name when there is a header (a '#' line or plain), else the first
// two; separated by commas, semicolons, tabs or blanks; further columns are ignored. Coordinates
// are those of the grid of `frame`. Columns of latitude and longitude, WPL and .plan files are in
// degrees and need a georeferenced map. GeoJSON is [lon, lat] on such a map, else in metres.
#pragma once

#include <filesystem>
#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/map/obstacle_map.hpp"

namespace fairway {

/// Vertices in the frame of `frame.grid`, metres; consecutive equal vertices count once, and with
/// `closed` a last vertex equal to the first is dropped. At least two distinct vertices, all
/// finite, all on the grid; otherwise throws InputError naming the line or item.
[[nodiscard]] std::vector<Vec2> read_path(const std::filesystem::path& file,
                                          const ObstacleMap& frame, bool closed = false);

/// The vertices as they are in the file, wherever they lie; they only have to be readable.
[[nodiscard]] std::vector<Vec2> path_vertices(const std::filesystem::path& file,
                                              const ObstacleMap& frame);

}  // namespace fairway
