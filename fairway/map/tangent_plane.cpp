#include "fairway/map/tangent_plane.hpp"

#include <algorithm>
#include <cmath>

#include <geodesic.h>

#include "fairway/base/heading.hpp"

namespace fairway {

namespace {

const geod_geodesic& wgs84() {
  static const geod_geodesic ellipsoid = [] {
    geod_geodesic g;
    geod_init(&g, 6378137.0, 1.0 / 298.257223563);
    return g;
  }();
  return ellipsoid;
}

constexpr double rad_per_deg = pi / 180.0;

}  // namespace

Vec2 TangentPlane::to_plane_m(GeodeticPoint point) const {
  double distance_m = 0.0;
  double azimuth_deg = 0.0;
  geod_inverse(&wgs84(), reference_.latitude_deg, reference_.longitude_deg, point.latitude_deg,
               point.longitude_deg, &distance_m, &azimuth_deg, nullptr);
  const double azimuth_rad = azimuth_deg * rad_per_deg;
  return {distance_m * std::sin(azimuth_rad), distance_m * std::cos(azimuth_rad)};
}

GeodeticPoint TangentPlane::from_plane(Vec2 point_m) const {
  GeodeticPoint point;
  const double azimuth_deg = std::atan2(point_m.x, point_m.y) / rad_per_deg;
  geod_direct(&wgs84(), reference_.latitude_deg, reference_.longitude_deg, azimuth_deg,
              norm(point_m), &point.latitude_deg, &point.longitude_deg, nullptr);
  return point;
}

double TangentPlane::worst_error_m(GeodeticPoint point) const {
  double distance_m = 0.0;
  double reduced_m = 0.0;
  geod_geninverse(&wgs84(), reference_.latitude_deg, reference_.longitude_deg, point.latitude_deg,
                  point.longitude_deg, &distance_m, nullptr, nullptr, &reduced_m, nullptr, nullptr,
                  nullptr);
  if (reduced_m <= 0.0) return 0.0;  // the reference itself
  return 2.0 * distance_m * std::max(0.0, distance_m / reduced_m - 1.0);
}

}  // namespace fairway
