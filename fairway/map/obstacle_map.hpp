// The map as planning sees it: a grid of cells, each obstacle or not, and where it came from.
//
// Properties that always hold: obstacle.size() == grid.size(); a cell is 1 if any obstacle point,
// grown by the footprint, lies in it (conservative), else 0; the grid's frame is metres, x to the
// right of the source map, y up.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fairway/base/grid.hpp"

namespace fairway {

/// A file that went into a product, with its SHA-256 in lower-case hex.
struct InputFile {
  std::string path;
  std::string sha256;
};

/// Reference point of the local tangent plane when the source was in degrees, and the worst error
/// of that plane over the map (already added to the growth of the obstacles).
struct GeoReference {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double worst_error_m = 0.0;
};

/// Pose of the grid's frame in the source's world frame (identity unless the map is rotated).
struct WorldFromGrid {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
};

struct ObstacleMap {
  Grid grid;
  std::vector<std::uint8_t> obstacle;  ///< [iy][ix], 1 obstacle, 0 not
  WorldFromGrid world_from_grid;
  std::optional<GeoReference> geo;
  std::optional<std::string> projected_crs;  ///< WKT of a projected source (GeoTIFF)
  std::vector<InputFile> inputs;
  std::vector<std::string> warnings;  ///< what the user should know, one sentence each
};

}  // namespace fairway
