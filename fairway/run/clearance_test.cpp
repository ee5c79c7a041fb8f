#include "fairway/run/clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/random.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

/// By looking at every obstacle.
double nearest_obstacle_m(const Plan& plan, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    if (plan.region[i] != Region::obstacle) continue;
    const Vec2 low = plan.grid.corner(plan.grid.cell_at(i));
    const double d = plan.grid.cell_m;
    least = std::min(least, std::hypot(std::max({low.x - p.x, 0.0, p.x - low.x - d}),
                                       std::max({low.y - p.y, 0.0, p.y - low.y - d})));
  }
  return least;
}

TEST(Clearance, IsTheDistanceToTheNearestObstacleCell) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Plan plan = random_plan(seed);
    const Clearance clearance(plan);
    Random random(seed);
    for (int k = 0; k < 50; ++k) {
      const Vec2 p{plan.grid.x0_m + random.uniform(-0.2, 1.2) * plan.grid.width_m(),
                   plan.grid.y0_m + random.uniform(-0.2, 1.2) * plan.grid.height_m()};
      const Cell c = plan.grid.cell_of(p);
      if (!plan.grid.contains(c)) continue;
      const double truth = nearest_obstacle_m(plan, p);
      if (std::isinf(truth)) {
        EXPECT_EQ(clearance.at(p), truth);
      } else {
        EXPECT_NEAR(clearance.at(p), truth, 1e-9 * plan.grid.cell_m) << seed;
      }
    }
  }
}

TEST(Clearance, AlongAFlightIsTheLeastOfItsPlacesToASixteenthOfACell) {
  std::size_t flights = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Plan plan = random_plan(seed);
    const ExactFlights engine(plan);
    const Clearance clearance(plan);
    Random random(seed);
    for (int k = 0; k < 5; ++k) {
      const State start{{plan.grid.x0_m + random.unit() * plan.grid.width_m(),
                         plan.grid.y0_m + random.unit() * plan.grid.height_m()},
                        Heading::from_rad(random.uniform(-pi, pi))};
      const Flight flight = engine.record(start);
      double truth = nearest_obstacle_m(plan, start.position_m);
      if (std::isinf(truth) || flight.segments.size() > 40) continue;
      for (const FlightSegment& piece : flight.segments) {
        const int steps = 2 + static_cast<int>(40.0 * piece.length_m / plan.grid.cell_m);
        for (int s = 0; s <= steps; ++s) {
          const double along_m = piece.length_m * s / steps;
          truth = std::min(truth, nearest_obstacle_m(plan, state_at(piece, along_m).position_m));
        }
      }
      const double found = clearance.least_along(flight);
      EXPECT_LE(found, truth + plan.grid.cell_m / 16.0) << seed;
      EXPECT_GE(found, truth - plan.grid.cell_m / 80.0) << seed;  // as fine as the truth is
      ++flights;
    }
  }
  EXPECT_GT(flights, 200U);
}

}  // namespace
}  // namespace fairway
