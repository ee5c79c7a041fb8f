#include "fairway/run/shortest_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

/// Whether a place can be on a line: some place beside it is neither in an obstacle nor outside.
bool is_open(const Plan& plan, Vec2 p) {
  const double beside = 1e-6 * plan.grid.cell_m;
  for (const Vec2 off : {Vec2{beside, beside}, Vec2{-beside, beside}, Vec2{beside, -beside},
                         Vec2{-beside, -beside}}) {
    const Cell c = plan.grid.cell_of(p + off);
    if (plan.grid.contains(c) && plan.region[plan.grid.index(c)] != Region::obstacle) return true;
  }
  return false;
}

bool is_clear(const Plan& plan, Vec2 a, Vec2 b) {
  constexpr int steps = 120;
  for (int s = 1; s < steps; ++s) {
    if (!is_open(plan, a + (static_cast<double>(s) / steps) * (b - a))) return false;
  }
  return true;
}

/// The shortest line from `start` through grid points to a goal cell's corner or side, by all
/// pairs: an oracle for small maps. Never shorter than the shortest line, and hardly longer.
double shortest_line_m(const Plan& plan, Vec2 start) {
  const Grid& g = plan.grid;
  std::vector<Vec2> points{start};
  for (int iy = 0; iy <= g.ny; ++iy) {
    for (int ix = 0; ix <= g.nx; ++ix) {
      points.push_back({g.x0_m + ix * g.cell_m, g.y0_m + iy * g.cell_m});
    }
  }
  const std::size_t ways = points.size();
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (plan.region[i] != Region::goal) continue;
    for (int k = 0; k <= 4; ++k) {
      const Vec2 low = g.corner(g.cell_at(i));
      const double along = k * g.cell_m / 4.0;
      for (const Vec2 off :
           {Vec2{along, 0.0}, Vec2{along, g.cell_m}, Vec2{0.0, along}, Vec2{g.cell_m, along}}) {
        points.push_back(low + off);
      }
    }
  }
  std::vector<double> best(points.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(points.size(), false);
  best[0] = 0.0;
  for (;;) {
    std::size_t at = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!done[i] && (at == points.size() || best[i] < best[at])) at = i;
    }
    if (at == points.size() || std::isinf(best[at])) return std::numeric_limits<double>::infinity();
    if (at >= ways) return best[at];
    done[at] = true;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double longer = best[at] + norm(points[i] - points[at]);
      if (!done[i] && longer < best[i] && is_clear(plan, points[at], points[i])) best[i] = longer;
    }
  }
}

Plan speckled_plan(std::uint64_t seed) {
  Random random(seed);
  Plan plan = empty_plan(9, 7, 2.0, 5.0);
  for (Region& region : plan.region) {
    if (random.unit() < 0.3) region = Region::obstacle;
  }
  plan.region[random.below(plan.grid.size())] = Region::goal;
  return plan;
}

TEST(LineAroundObstacles, IsNeverLongerThanTheShortestLine) {
  std::size_t reached = 0;
  double sum = 0.0;
  double truths = 0.0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Plan plan = speckled_plan(seed);
    const LengthBound bound = line_around_obstacles(plan);
    Random random(1000 + seed);
    for (int k = 0; k < 4; ++k) {
      const Vec2 p{random.unit() * plan.grid.width_m(), random.unit() * plan.grid.height_m()};
      const std::size_t cell = plan.grid.index(plan.grid.cell_of(p));
      if (plan.region[cell] == Region::obstacle || plan.region[cell] == Region::goal) continue;
      const double truth = shortest_line_m(plan, p);
      const double found = bound.length_m({p, {}});
      if (std::isinf(truth)) continue;
      EXPECT_LE(found, truth + 1e-9) << seed << ": " << p.x << ", " << p.y;
      ++reached;
      sum += found;
      truths += truth;
    }
  }
  EXPECT_GT(reached, 60U);
  EXPECT_GT(sum, 0.6 * truths);  // on maps of nine cells, where three cells are much
}

TEST(LineAroundObstacles, IsNeverLongerThanAFlight) {
  std::size_t reached = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Plan plan = random_plan(seed);
    const LengthBound bound = line_around_obstacles(plan);
    const ExactFlights engine(plan);
    Random random(seed);
    for (int k = 0; k < 20; ++k) {
      const State start{{plan.grid.x0_m + random.unit() * plan.grid.width_m(),
                         plan.grid.y0_m + random.unit() * plan.grid.height_m()},
                        Heading::from_rad(random.uniform(-pi, pi))};
      const FlightResult flight = engine.fly(start);
      if (flight.outcome != Outcome::reach) continue;
      EXPECT_LE(bound.length_m(start), flight.length_m + 1e-9 * plan.grid.cell_m) << seed;
      ++reached;
    }
  }
  EXPECT_GT(reached, 200U);
}

TEST(LineAroundObstacles, IsTheDistanceOnAnEmptyMapAndGoesRoundAWall) {
  Plan plan = empty_plan(60, 40, 2.0, 5.0);
  plan.region[plan.grid.index({50, 20})] = Region::goal;
  const LengthBound empty = line_around_obstacles(plan);
  EXPECT_DOUBLE_EQ(empty.length_m({{10.0, 41.0}, {}}), 90.0);
  EXPECT_DOUBLE_EQ(empty.length_m({{97.0, 36.0}, {}}), 5.0);
  EXPECT_EQ(empty.length_m({{101.0, 41.0}, {}}), 0.0);
  for (int iy = 0; iy < 36; ++iy) plan.region[plan.grid.index({30, iy})] = Region::obstacle;
  // From (20, 41) over the wall's corners (60, 72) and (62, 72) to the goal's corner (100, 42).
  const double way = std::hypot(40.0, 31.0) + 2.0 + std::hypot(38.0, 30.0);
  const double found = line_around_obstacles(plan).length_m({{20.0, 41.0}, {}});
  EXPECT_LE(found, way);
  EXPECT_GE(found, 0.92 * way - 6.0);
  for (int iy = 36; iy < 40; ++iy) plan.region[plan.grid.index({30, iy})] = Region::obstacle;
  EXPECT_TRUE(std::isinf(line_around_obstacles(plan).length_m({{20.0, 41.0}, {}})));
}

}  // namespace
}  // namespace fairway
