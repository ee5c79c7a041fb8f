#include "fairway/field/flyable_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/vehicle/path_geometry.hpp"
#include "fairway/vehicle/path_locator.hpp"

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

/// How sharply a path bends at most, over half a radius.
double sharpest_bend_m(const PathMission& path, double radius_m) {
  const PathLocator line(path);
  const double half_m = 0.25 * radius_m;
  double least_m = 1e9;
  for (double at_m = half_m; at_m + half_m < line.length_m(); at_m += 0.05 * radius_m) {
    const Vec2 here = line.place(at_m);
    const Vec2 before = here - line.place(at_m - half_m);
    const Vec2 after = line.place(at_m + half_m) - here;
    const double turn = std::abs(Heading::of(before).turn_to(Heading::of(after)));
    if (turn > 0.0) least_m = std::min(least_m, half_m / turn);
  }
  return least_m;
}

/// A bend by `turn_rad` of radius `bend_m` between straights.
PathMission bend(double bend_m, double turn_rad) {
  PathMission path{{{-100.0, -bend_m}}, false};
  for (int k = 0; k <= 40; ++k) {
    const double at = -0.5 * pi + turn_rad * k / 40.0;
    path.vertices_m.push_back({bend_m * std::cos(at), bend_m * std::sin(at)});
  }
  path.vertices_m.push_back(path.vertices_m.back() + 100.0 * Heading::from_rad(turn_rad).unit());
  return path;
}

TEST(FollowedLine, BendsMoreGentlyWhereThereIsRoomAndNowhereMoreSharply) {
  constexpr double turn_m = 20.0;
  for (const double bend_m : {10.0, 16.0, 20.0, 25.0, 35.0}) {
    for (const double turn_rad : {0.8, 1.6, 2.4, 3.1, 4.7}) {
      const PathMission path = bend(bend_m, turn_rad);
      const double before_m = sharpest_bend_m(flyable_path(path, turn_m), turn_m);
      const double after_m = sharpest_bend_m(followed_line(path, turn_m), turn_m);
      EXPECT_GE(after_m, 0.98 * before_m) << bend_m << " " << turn_rad;
      if (turn_rad > 2.0 || bend_m > turn_m) continue;
      EXPECT_GT(after_m, 1.1 * before_m) << bend_m << " " << turn_rad;
    }
  }
}

TEST(FollowedLine, IsThePathWhereItIsGentle) {
  const PathMission path = bend(35.0, 2.0);
  const PathLocator line(followed_line(path, 20.0));
  for (const Vec2 v : path.vertices_m) EXPECT_LT(line.nearest(v).distance_m, 0.05);
}

}  // namespace
}  // namespace fairway
