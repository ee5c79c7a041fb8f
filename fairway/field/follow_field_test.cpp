#include "fairway/field/follow_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/vehicle/path_locator.hpp"
#include "fairway/vehicle/path_troubles.hpp"

namespace fairway {
namespace {

constexpr double r = 20.0;

ObstacleMap open_ground(int nx, int ny, double cell_m) {
  ObstacleMap map;
  map.grid = {nx, ny, 0.0, 0.0, cell_m};
  map.obstacle.assign(map.grid.size(), 0);
  return map;
}

Field field_of(const ObstacleMap& map, const PathMission& path, PathField kind = PathField::follow,
               double alpha = 2.0) {
  FieldOptions options;
  options.path_field = kind;
  options.alpha = alpha;
  options.axis_capture_rad = 0.0;
  return std::get<Field>(compute_field(map, {10.0, r}, path, options));
}

PathMission random_path(Random& random) {
  for (;;) {
    PathMission path;
    path.closed = random.below(2) == 0;
    Vec2 at{random.uniform(150.0, 450.0), random.uniform(150.0, 450.0)};
    double heading = random.uniform(-pi, pi);
    const auto vertices = 3 + random.below(10);
    for (std::size_t k = 0; k < vertices; ++k) {
      path.vertices_m.push_back(at);
      at = at + r * random.uniform(1.0, 5.0) * Heading::from_rad(heading).unit();
      heading += random.uniform(-0.8, 0.8);
    }
    const bool inside = std::all_of(path.vertices_m.begin(), path.vertices_m.end(), [](Vec2 p) {
      return p.x > 10.0 && p.x < 590.0 && p.y > 10.0 && p.y < 590.0;
    });
    if (inside && path_troubles(path, 1.5 * r).empty()) return path;
  }
}

TEST(ApproachAngle, IsThatOfACircleTangentToTheLineAndLinearNextToIt) {
  EXPECT_EQ(approach_angle_rad(0.0, 50.0, 10.0), 0.0);
  EXPECT_NEAR(approach_angle_rad(3.0, 50.0, 10.0), 0.3, 1e-12);
  EXPECT_NEAR(approach_angle_rad(25.0, 50.0, 10.0), std::acos(0.5), 1e-12);
  EXPECT_NEAR(approach_angle_rad(50.0, 50.0, 10.0), pi / 2, 1e-12);
  EXPECT_NEAR(approach_angle_rad(1e6, 50.0, 10.0), pi / 2, 1e-12);
}

// So that a vehicle that flies as it says, with R >= 2 r, turns no more sharply than it can.
TEST(ApproachAngle, AsksForNoSharperTurnThanHalfTheCircle) {
  Random random(61);
  for (int i = 0; i < 2000; ++i) {
    const double circle_m = random.uniform(1.0, 80.0);
    const double radian_m = random.uniform(0.1, 1.0) * circle_m;
    const double near_m = random.uniform(0.0, circle_m);
    const double far_m = near_m + random.uniform(1e-4, 1e-2) * circle_m;
    const double near_rad = approach_angle_rad(near_m, circle_m, radian_m);
    const double far_rad = approach_angle_rad(far_m, circle_m, radian_m);
    EXPECT_LE(near_rad, far_rad);
    if (far_m > circle_m) continue;
    EXPECT_LE(std::cos(near_rad) - std::cos(far_rad), 2.0 * (far_m - near_m) / circle_m * 1.01);
  }
}

TEST(FollowField, OfAStraightPathIsTheFormula) {
  const double cell_m = 8.0;
  const ObstacleMap map = open_ground(80, 70, cell_m);
  for (const double turn : {0.0, 0.3, 1.2, 2.5}) {
    const Vec2 middle{322.0, 283.0};
    const Vec2 u = Heading::from_rad(turn).unit();
    const PathMission path{{middle - 120.0 * u, middle + 120.0 * u}, false};
    const Field field = field_of(map, path);
    const PathLocator locator(path);
    int looked_at = 0;
    for (std::size_t i = 0; i < field.heading_rad.size(); ++i) {
      const Vec2 p = map.grid.center(map.grid.cell_at(i));
      const PathFrame frame = locator.frame(p);
      const double distance_m = std::abs(frame.offset_m);
      if (frame.beyond_m > 0.0 || distance_m >= 2.4 * r) continue;
      const double angle = approach_angle_rad(distance_m, 2.5 * r, 0.5 * r);
      const double expected = turn + (frame.offset_m > 0.0 ? -angle : angle);
      const Heading found = Heading::from_rad(static_cast<double>(field.heading_rad[i]));
      EXPECT_NEAR(found.turn_to(Heading::from_rad(expected)), 0.0, 0.02) << p.x << " " << p.y;
      ++looked_at;
    }
    EXPECT_GT(looked_at, 300);
  }
}

TEST(FollowField, NeverPointsBackwardsBesideThePath) {
  Random random(62);
  for (int i = 0; i < 40; ++i) {
    const PathMission path = random_path(random);
    const double cell_m = random.uniform(3.0, 10.0);
    const int n = static_cast<int>(600.0 / cell_m);
    const Field field = field_of(open_ground(n, n, cell_m), path);
    const PathLocator locator(path);
    for (std::size_t k = 0; k < field.heading_rad.size(); ++k) {
      const PathFrame frame = locator.frame(field.grid.center(field.grid.cell_at(k)));
      // Where two parts of the path are about equally near, either may be the one followed.
      if (frame.beyond_m > 0.0 || std::abs(frame.offset_m) > r) continue;
      const Vec2 u = Heading::from_rad(static_cast<double>(field.heading_rad[k])).unit();
      EXPECT_GT(dot(u, frame.tangent), -0.1) << "path " << i << " offset " << frame.offset_m;
    }
  }
}

TEST(FollowField, LeadsNowhereIntoAnObstacleWhereThePapersDoesNot) {
  Random random(63);
  for (int i = 0; i < 20; ++i) {
    ObstacleMap map = open_ground(60, 60, 8.0);
    const PathMission path{{{40.0, 240.0}, {440.0, 250.0}}, false};
    for (int k = 0; k < 12; ++k) {
      const Cell at{static_cast<int>(random.below(60)), static_cast<int>(random.below(60))};
      if (std::abs(8.0 * at.iy - 245.0) < 26.0) continue;
      map.obstacle[map.grid.index(at)] = 1;
    }
    const Field follow = field_of(map, path, PathField::follow, 0.5);
    const Field paper = field_of(map, path, PathField::paper, 0.5);
    const auto clear = [&](const Field& field, std::size_t k) {
      const Vec2 u = Heading::from_rad(static_cast<double>(field.heading_rad[k])).unit();
      for (double along_m = 2.0; along_m < r; along_m += 2.0) {
        const Cell c = map.grid.cell_of(map.grid.center(map.grid.cell_at(k)) + along_m * u);
        if (map.grid.contains(c) && map.obstacle[map.grid.index(c)] != 0) return along_m;
      }
      return r;
    };
    for (std::size_t k = 0; k < follow.heading_rad.size(); ++k) {
      if (std::isnan(follow.heading_rad[k])) continue;
      EXPECT_GE(clear(follow, k), clear(paper, k)) << "map " << i << " cell " << k;
    }
  }
}

TEST(FollowField, LeavesRegionsCostsAndWhatHasACommandAsTheyAre) {
  const ObstacleMap map = open_ground(60, 60, 8.0);
  const PathMission path{{{100.0, 240.0}, {380.0, 250.0}}, false};
  const Field follow = field_of(map, path);
  const Field paper = field_of(map, path, PathField::paper);
  EXPECT_EQ(follow.region, paper.region);
  EXPECT_EQ(follow.cost_m, paper.cost_m);
  const PathLocator locator(path);
  std::size_t changed = 0;
  for (std::size_t k = 0; k < follow.heading_rad.size(); ++k) {
    EXPECT_EQ(std::isnan(follow.heading_rad[k]), std::isnan(paper.heading_rad[k]));
    if (follow.heading_rad[k] == paper.heading_rad[k]) continue;
    ++changed;
    const PathFrame frame = locator.frame(map.grid.center(map.grid.cell_at(k)));
    EXPECT_LT(std::abs(frame.offset_m), 2.5 * r);
  }
  EXPECT_GT(changed, 100U);
}

TEST(FollowField, MirrorsWithThePath) {
  const ObstacleMap map = open_ground(60, 60, 8.0);
  Random random(64);
  for (int i = 0; i < 5; ++i) {
    const PathMission path = random_path(random);
    PathMission mirrored = path;
    for (Vec2& v : mirrored.vertices_m) v.y = 480.0 - v.y;
    const bool inside = std::all_of(path.vertices_m.begin(), path.vertices_m.end(),
                                    [](Vec2 p) { return p.x < 470.0 && p.y < 470.0; });
    if (!inside) continue;
    const Field here = field_of(map, path);
    const Field there = field_of(map, mirrored);
    std::size_t apart = 0;  // where two parts of the path are equally near
    for (int iy = 0; iy < 60; ++iy) {
      for (int ix = 0; ix < 60; ++ix) {
        const auto a = static_cast<double>(here.heading_rad[map.grid.index({ix, iy})]);
        const auto b = static_cast<double>(there.heading_rad[map.grid.index({ix, 59 - iy})]);
        apart += std::abs(std::remainder(a + b, two_pi)) > 0.01 ? 1 : 0;
      }
    }
    EXPECT_LT(apart, 100U) << "path " << i;
  }
}

TEST(FollowField, PointsBackAtTheEndsOfAnOpenPathBeyondThem) {
  const ObstacleMap map = open_ground(60, 60, 8.0);
  const PathMission path{{{150.0, 240.0}, {330.0, 250.0}}, false};
  const PathLocator locator(path);
  for (const Blend blend : {Blend::continuous, Blend::paper}) {
    FieldOptions options;
    options.blend = blend;
    const Field field = std::get<Field>(compute_field(map, {10.0, r}, path, options));
    std::size_t beyond = 0;
    for (std::size_t k = 0; k < field.heading_rad.size(); ++k) {
      const Vec2 p = map.grid.center(map.grid.cell_at(k));
      const PathFrame frame = locator.frame(p);
      if (frame.beyond_m == 0.0 || std::abs(frame.offset_m) > 2.4 * r) continue;
      const Heading back = Heading::of(path.vertices_m[frame.station_m > 0.0 ? 1 : 0] - p);
      const Heading found = Heading::from_rad(static_cast<double>(field.heading_rad[k]));
      EXPECT_NEAR(back.turn_to(found), 0.0, 0.03);
      ++beyond;
    }
    EXPECT_GT(beyond, 50U);
  }
}

TEST(FollowField, OfTurnsNarrowerThanTheVehiclesAndOfThereAndBackIsFinite) {
  const ObstacleMap map = open_ground(60, 60, 8.0);
  const PathMission there_and_back{{{100.0, 240.0}, {380.0, 240.0}}, true};
  const PathMission hairpin{{{100.0, 240.0}, {380.0, 240.0}, {380.0, 250.0}, {100.0, 250.0}},
                            false};
  const PathMission twice{{{100.0, 240.0}, {100.0, 240.0}, {300.0, 250.0}, {300.0, 250.0}}, false};
  for (const PathMission& path : {there_and_back, hairpin, twice}) {
    for (const float heading : field_of(map, path).heading_rad) EXPECT_TRUE(std::isfinite(heading));
  }
}

}  // namespace
}  // namespace fairway
