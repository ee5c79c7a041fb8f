// What a tube says of a part holds for every place of it.
#include <cmath>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"
#include "fairway/inclusion/tube.hpp"
#include "fairway/vehicle/path_geometry.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

PathMission some_path(Random& random, const Grid& grid, bool closed) {
  PathMission path;
  path.closed = closed;
  const auto vertices = 3 + random.below(5);
  for (std::uint64_t k = 0; k < vertices; ++k) {
    path.vertices_m.push_back(
        grid.center({static_cast<int>(random.below(static_cast<std::uint64_t>(grid.nx))),
                     static_cast<int>(random.below(static_cast<std::uint64_t>(grid.ny)))}) +
        Vec2{random.unit(), random.unit()});
  }
  return path;
}

TEST(Tube, HoldsDistancesAndTangentsOfEveryPlace) {
  Random random(3);
  int inside = 0;
  for (std::uint64_t seed = 1; seed < 9; ++seed) {
    const Plan plan = random_plan(seed);
    const PlanFlow held(plan);
    const Parts parts(held.flow(), VehicleContract::of(plan.vehicle),
                      1 + static_cast<int>(seed % 3));
    const PathLocator path(some_path(random, plan.grid, seed % 2 == 0));
    const double widest_m = random.uniform(2.0, 6.0) * plan.grid.cell_m;
    const Tube tube(parts, plan.grid, path, widest_m);
    for (int k = 0; k < 4000; ++k) {
      const Vec2 at{random.uniform(0.0, parts.nx()), random.uniform(0.0, parts.ny())};
      const std::size_t part = parts.index({static_cast<int>(at.x), static_cast<int>(at.y)});
      const Vec2 place = Vec2{plan.grid.x0_m, plan.grid.y0_m} + parts.part_m() * at;
      const PathPoint nearest = nearest_on_path(place, path.path());
      if (tube.distance_m(part) == Tube::outside) {
        EXPECT_GT(nearest.distance_m + 1.5 * parts.part_m(), widest_m);
        continue;
      }
      ++inside;
      EXPECT_LE(nearest.distance_m, static_cast<double>(tube.distance_m(part)));
      EXPECT_LE(tube.distance_m(part), widest_m * (1.0 + 1e-6));
      EXPECT_TRUE(tube.tangents(part).widened(1e-9).meets({nearest.tangent.rad(), 0.0}));
      const HeadingArc headings{random.uniform(-7.0, 7.0), random.uniform(0.0, 1.0)};
      const double heading = headings.lo_rad + random.unit() * headings.width_rad;
      EXPECT_LE(std::abs(std::remainder(heading - nearest.tangent.rad(), whole_turn_rad)),
                tube.off_rad(part, headings) + 1e-9);
    }
  }
  EXPECT_GT(inside, 3000);
}

TEST(Tube, CountsCornersOnceRoundTheClock) {
  const Plan plan = random_plan(1);
  const PlanFlow held(plan);
  const Parts parts(held.flow(), VehicleContract::of(plan.vehicle), 1);
  PathMission square;
  square.vertices_m = {{10.0, 10.0}, {40.0, 10.0}, {40.0, 30.0}, {10.0, 30.0}};
  square.closed = true;
  const Tube closed(parts, plan.grid, PathLocator(square), 10.0);
  EXPECT_NEAR(closed.turning_rad(0.0, closed.length_m()), 2.0 * pi, 1e-12);
  EXPECT_NEAR(closed.turning_rad(25.0, 55.0), pi, 1e-12);
  EXPECT_NEAR(closed.ahead_m(95.0, 5.0), 10.0, 1e-12);
  EXPECT_NEAR(closed.ahead_m(5.0, 95.0), -10.0, 1e-12);
  square.closed = false;
  const Tube open(parts, plan.grid, PathLocator(square), 10.0);
  EXPECT_NEAR(open.turning_rad(0.0, open.length_m()), pi, 1e-12);
  EXPECT_NEAR(open.ahead_m(5.0, 75.0), 70.0, 1e-12);
}

}  // namespace
}  // namespace fairway
