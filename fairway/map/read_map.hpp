// Reads a map file of any supported kind into the grid that planning sees.
//
//   ROS map_server .yaml (trinary, scale, raw), MovingAI .map, GeoJSON, QGroundControl .plan,
//   ArduPilot fence text, QGC WPL 110, and images (PGM, PPM, PNG, BMP, JPEG, TIFF, GeoTIFF) with a
//   geotransform, a world file or `resolution_m`. The kind is found by content, then by extension.
//
// Frames: ROS maps and rasters keep their own world coordinates; a ROS map whose origin is rotated
// is placed in the map's own frame, lower-left corner at (0, 0), and `world_from_grid` gives its
// pose in the world; maps without a scale of their own have their lower-left corner at (0, 0);
// degrees become metres in a local tangent plane about a recorded reference point, x east, y north.
//
// Properties that always hold of the result:
//   1. Conservative: a cell that any obstacle point grown by the footprint touches is an obstacle.
//      For pixels, "touches" means that the interiors overlap, so that cells as large as pixels
//      reproduce the image. Rounding of at most 1e-9 of a pixel adds no rows or columns.
//   2. With `outside_is_obstacle` the grid has a ring of one obstacle cell on each side, and the
//      outside grows by the footprint too; without, cells that extend beyond the map are free
//      there.
//   3. The result depends only on the files and the request, never on the number of threads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/map/obstacle_map.hpp"

namespace fairway {

/// What several keep-in fences mean together. Autopilots and people disagree, so we never guess.
enum class Inclusion {
  all,  ///< the vehicle must stay in every one of them (intersection)
  any   ///< the vehicle must stay in at least one of them (union)
};

/// A point on the WGS84 ellipsoid.
struct GeodeticPoint {
  double latitude_deg = 0.0;   ///< [-90, 90]
  double longitude_deg = 0.0;  ///< [-180, 180]
  friend constexpr bool operator==(const GeodeticPoint&, const GeodeticPoint&) = default;
};

/// Everything a map needs besides its file. Names follow the scenario's [map] keys.
struct MapRequest {
  std::filesystem::path file;
  double cell_m = 1.0;                 ///< side of a plan cell, > 0
  std::optional<double> resolution_m;  ///< > 0; metres per pixel where the file has no scale
  std::optional<Inclusion> inclusion;  ///< required when there are several keep-in fences
  bool unknown_is_obstacle = true;
  bool outside_is_obstacle = true;
  double footprint_radius_m = 0.0;         ///< >= 0
  std::optional<GeodeticPoint> reference;  ///< of the tangent plane; else home, else the centre
  /// Elevation rasters and GeoJSON with heights: obstacle where height > altitude_m - margin_m.
  std::optional<double> altitude_m;
  double margin_m = 0.0;  ///< >= 0, height to keep above the ground
  /// Free margin around obstacles and mission when no keep-in fence bounds the world, >= 0;
  /// by default a tenth of the longer side of their bounding box, at least ten cells, and at least
  /// `least_world_margin_m` (>= 0), which the caller derives from how wide the vehicle turns.
  std::optional<double> world_margin_m;
  double least_world_margin_m = 0.0;
  /// The mission: where no keep-in fence bounds the world, it also contains these places, in metres
  /// of the map's plane, in degrees, and the vertices of a path file (read_path.hpp).
  std::vector<Vec2> also_hold_m;
  std::vector<GeodeticPoint> also_hold_deg;
  std::optional<std::filesystem::path> also_hold_path;
  /// "FILE:LINE" of a key such as "map.file", when called for a scenario: errors then include it.
  std::function<std::string(std::string_view key)> place_of;
  std::uint64_t max_pixels = std::uint64_t{1} << 28;  ///< larger images are refused unread
  std::uint64_t max_cells = std::uint64_t{1} << 28;   ///< larger grids are refused unallocated
};

/// All supported kinds of file, for messages and documentation: "ROS map_server .yaml, ...".
[[nodiscard]] std::string map_kinds_text();

/// Throws InputError naming the file and the line, key or feature. Cost: linear in pixels plus
/// cells.
[[nodiscard]] ObstacleMap read_map(const MapRequest& request);

}  // namespace fairway
