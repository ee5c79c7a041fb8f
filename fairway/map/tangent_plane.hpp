// Degrees to metres about a reference point, with the error of that.
//
// The map is the azimuthal equidistant one on the WGS84 ellipsoid, by geodesics: the reference is
// (0, 0), a point at geodesic distance s and azimuth a (clockwise from north) is at
// (s sin a, s cos a).
//   1. Distances and directions from the reference are exact.
//   2. Across a radius the plane is too wide by the factor s / m, m being the reduced length of the
//      geodesic (on a sphere of radius E: s/E / sin(s/E), about 1 + s^2 / (6 E^2)). Every line
//      between two points of a disc about the reference of radius s is therefore at most
//      2 s (s / m - 1) too long. Derived; 8.2e-6 m for 1 km, 8.2e-3 m for 10 km, 8.2 m for 100 km.
// Source: C. F. F. Karney, Algorithms for geodesics, 2013, in PROJ's geodesic.h.
#pragma once

#include "fairway/base/vec2.hpp"
#include "fairway/map/read_map.hpp"

namespace fairway {

/// Points farther than this from the reference do not belong to a local map.
inline constexpr double tangent_plane_limit_m = 100e3;

class TangentPlane {
 public:
  explicit TangentPlane(GeodeticPoint reference) : reference_(reference) {}

  GeodeticPoint reference() const { return reference_; }

  [[nodiscard]] Vec2 to_plane_m(GeodeticPoint point) const;
  [[nodiscard]] GeodeticPoint from_plane(Vec2 point_m) const;

  /// Property 2's bound for the disc through `point`, metres.
  [[nodiscard]] double worst_error_m(GeodeticPoint point) const;

 private:
  GeodeticPoint reference_;
};

}  // namespace fairway
