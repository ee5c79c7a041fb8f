#include "fairway/map/tangent_plane.hpp"

#include <cmath>

#include <geodesic.h>
#include <gtest/gtest.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/map/geodetic_fences.hpp"

namespace fairway {
namespace {

double geodesic_m(GeodeticPoint a, GeodeticPoint b) {
  geod_geodesic wgs84;
  geod_init(&wgs84, 6378137.0, 1.0 / 298.257223563);
  double distance_m = 0.0;
  geod_inverse(&wgs84, a.latitude_deg, a.longitude_deg, b.latitude_deg, b.longitude_deg,
               &distance_m, nullptr, nullptr);
  return distance_m;
}

GeodeticPoint random_reference(Random& random) {
  return {random.uniform(-85.0, 85.0), random.uniform(-180.0, 180.0)};
}

TEST(TangentPlane, ThereAndBackIsTheSamePoint) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const TangentPlane plane(random_reference(random));
    const Vec2 p{random.uniform(-7e4, 7e4), random.uniform(-7e4, 7e4)};
    EXPECT_LT(norm(plane.to_plane_m(plane.from_plane(p)) - p), 1e-7);
  }
  EXPECT_EQ(norm(TangentPlane({47.0, 8.0}).to_plane_m({47.0, 8.0})), 0.0);
}

TEST(TangentPlane, NorthIsUpAndEastIsRight) {
  const TangentPlane plane({47.0, 8.0});
  const Vec2 north = plane.to_plane_m({47.001, 8.0});
  const Vec2 east = plane.to_plane_m({47.0, 8.001});
  EXPECT_NEAR(north.y, 111.18, 0.05);
  EXPECT_NEAR(north.x, 0.0, 1e-9);
  EXPECT_NEAR(east.x, 76.06, 0.05);
  EXPECT_NEAR(east.y, 0.0, 1e-3);
}

TEST(TangentPlane, NoDistanceInADiscIsFartherOffThanTheStatedError) {
  Random random(6);
  double largest_share = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const TangentPlane plane(random_reference(random));
    const double radius_m = std::pow(10.0, random.uniform(3.0, 5.0));
    const auto in_disc = [&] {
      const double angle = random.uniform(-pi, pi);
      const double r = radius_m * std::sqrt(random.unit());
      return Vec2{r * std::cos(angle), r * std::sin(angle)};
    };
    const Vec2 p = in_disc();
    const Vec2 q = in_disc();
    const double error_m =
        std::abs(norm(p - q) - geodesic_m(plane.from_plane(p), plane.from_plane(q)));
    const double bound_m = plane.worst_error_m(plane.from_plane({radius_m, 0.0}));
    EXPECT_LE(error_m, 1.01 * bound_m + 1e-7);
    largest_share = std::max(largest_share, error_m / bound_m);
  }
  EXPECT_GT(largest_share, 0.3) << "the bound should not be vacuous";
}

TEST(TangentPlane, EdgesStraightInDegreesStayWithinTheStatedErrorOfThePlanesPieces) {
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    const GeodeticPoint home{random.uniform(-70.0, 70.0), random.uniform(-170.0, 170.0)};
    const auto near_home = [&] {
      return GeodeticPoint{home.latitude_deg + random.uniform(-0.2, 0.2),
                           home.longitude_deg + random.uniform(-0.2, 0.2)};
    };
    GeodeticFences fences;
    const std::vector<GeodeticPoint> corners = {near_home(), near_home(), near_home()};
    fences.polygons.push_back({false, "test", {{corners, {}}}});
    const FenceSet set = in_tangent_plane(fences, home);
    const auto& ring = set.keep_out.at(0).rings_m.at(0);
    const TangentPlane plane(home);
    // Any point of the edge in degrees lies near the ring in the plane.
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const double t = random.unit();
      const GeodeticPoint a = corners[edge];
      const GeodeticPoint b = corners[(edge + 1) % 3];
      const Vec2 p = plane.to_plane_m({a.latitude_deg + t * (b.latitude_deg - a.latitude_deg),
                                       a.longitude_deg + t * (b.longitude_deg - a.longitude_deg)});
      double nearest = 1e300;
      for (std::size_t j = 0; j < ring.size(); ++j) {
        const Vec2 u = ring[j];
        const Vec2 v = ring[(j + 1) % ring.size()];
        const double s = std::clamp(dot(p - u, v - u) / norm2(v - u), 0.0, 1.0);
        nearest = std::min(nearest, norm(p - (u + s * (v - u))));
      }
      EXPECT_LE(nearest, set.geo->worst_error_m) << i;
      EXPECT_LE(nearest, 1.1e-3);
    }
  }
}

}  // namespace
}  // namespace fairway
