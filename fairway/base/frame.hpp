// Where a grid's metric frame lies in the world: in the frame of the map's source, and on Earth.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "fairway/base/vec2.hpp"

namespace fairway {

/// Reference point of the local tangent plane when the source was in degrees, and the worst error
/// of that plane over the map (already added to the growth of the obstacles).
struct GeoReference {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double worst_error_m = 0.0;
  friend bool operator==(const GeoReference&, const GeoReference&) = default;
};

/// Pose of the grid's frame in the source's world frame (identity unless the map is rotated).
struct WorldFromGrid {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  friend bool operator==(const WorldFromGrid&, const WorldFromGrid&) = default;
};

struct Frame {
  WorldFromGrid world_from_grid;
  std::optional<GeoReference> geo;
  std::optional<std::string> projected_crs;  ///< WKT of a projected source (GeoTIFF)

  bool is_on_earth() const { return geo.has_value() || projected_crs.has_value(); }
  friend bool operator==(const Frame&, const Frame&) = default;
};

struct LonLat {
  double longitude_deg = 0.0;
  double latitude_deg = 0.0;
};
/// A state as navigators write it: where on the WGS84 ellipsoid, and the course over ground,
/// degrees clockwise from true north.
struct EarthState {
  double latitude_deg = 0.0;   ///< [-90, 90]
  double longitude_deg = 0.0;  ///< [-180, 180]
  double course_deg = 0.0;     ///< [-360, 360]; [0, 360) where Fairway writes it
  friend bool operator==(const EarthState&, const EarthState&) = default;
};
/// The place on Earth of a point of a frame; empty when the frame is not georeferenced.
using LonLatOf = std::function<LonLat(Vec2 position_m)>;

}  // namespace fairway
