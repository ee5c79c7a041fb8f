#include "fairway/field/flyable_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway {
namespace {

/// Of the circle through three points that follow each other.
double sharpest_radius_m(const PathMission& path) {
  const std::vector<Vec2>& p = path.vertices_m;
  const std::size_t n = p.size();
  double least_m = 1e9;
  for (std::size_t i = path.closed ? 0 : 1; i < (path.closed ? n : n - 1); ++i) {
    const Vec2 a = p[(i + n - 1) % n];
    const Vec2 c = p[(i + 1) % n];
    const double area2 = std::abs(cross(p[i] - a, c - a));
    if (area2 < 1e-12) continue;
    least_m = std::min(least_m, norm(p[i] - a) * norm(c - p[i]) * norm(c - a) / (2.0 * area2));
  }
  return least_m;
}

double farthest_m(const PathMission& from, const PathMission& path) {
  double most_m = 0.0;
  for (const Vec2 v : from.vertices_m) {
    most_m = std::max(most_m, nearest_on_path(v, path).distance_m);
  }
  return most_m;
}

TEST(FlyablePath, CutsACornerByAnArc) {
  const double r = 2.0;
  for (const double turn : {0.5, 1.0, pi / 2, 2.0}) {
    const PathMission corner{{{-20.0, 0.0}, {0.0, 0.0}, 20.0 * Heading::from_rad(turn).unit()},
                             false};
    const PathMission line = flyable_path(corner, r);
    EXPECT_GT(sharpest_radius_m(line), 0.97 * r) << turn;
    // An arc of radius r inside the corner passes the vertex at r (1 / cos(turn / 2) - 1).
    const double inside_m = r * (1.0 / std::cos(0.5 * turn) - 1.0);
    EXPECT_NEAR(nearest_on_path({0.0, 0.0}, line).distance_m, std::min(inside_m, r), 0.05 * r)
        << turn;
  }
}

TEST(FlyablePath, IsThePathWhereThatBendsGently) {
  PathMission circle;
  circle.closed = true;
  for (int k = 0; k < 400; ++k) {
    circle.vertices_m.push_back(10.0 * Heading::from_rad(two_pi * k / 400).unit());
  }
  const PathMission line = flyable_path(circle, 2.0);
  EXPECT_LT(farthest_m(line, circle), 0.02);
  EXPECT_LT(farthest_m(circle, line), 0.02);
  const PathMission straight{{{0.0, 0.0}, {30.0, 10.0}}, false};
  EXPECT_LT(farthest_m(flyable_path(straight, 2.0), straight), 1e-9);
}

TEST(FlyablePath, NeverLeavesThePathByMoreThanTheRadiusAndKeepsOpenEnds) {
  Random random(91);
  for (int i = 0; i < 60; ++i) {
    PathMission path;
    path.closed = i % 2 == 0;
    const auto vertices = 2 + random.below(8);
    for (std::size_t k = 0; k < vertices; ++k) {
      const bool again = k > 1 && random.below(6) == 0;
      path.vertices_m.push_back(again ? path.vertices_m[k - 1 - random.below(2)]
                                      : Vec2{random.uniform(0.0, 30.0), random.uniform(0.0, 30.0)});
    }
    const double r = random.uniform(0.5, 6.0);
    const PathMission line = flyable_path(path, r);
    EXPECT_LE(farthest_m(line, path), r + 1e-9);
    EXPECT_EQ(line.closed, path.closed);
    for (const Vec2 v : line.vertices_m) ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y));
    if (path.closed) continue;
    EXPECT_EQ(line.vertices_m.front(), path.vertices_m.front());
    EXPECT_EQ(line.vertices_m.back(), path.vertices_m.back());
  }
}

TEST(FlyablePath, AsksForAPathAndARadius) {
  EXPECT_THROW((void)flyable_path({{{0.0, 0.0}}, false}, 1.0), PreconditionViolation);
  EXPECT_THROW((void)flyable_path({{{0.0, 0.0}, {1.0, 0.0}}, false}, 0.0), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
