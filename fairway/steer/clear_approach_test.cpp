#include "fairway/steer/clear_approach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/steer/testing/dubins_oracle.hpp"

namespace fairway {
namespace {

struct World {
  Grid grid{24, 20, -3.0, 2.0, 1.5};
  std::vector<std::uint8_t> blocked;
  BlockedCells cells(bool outside_blocked = true) const { return {grid, blocked, outside_blocked}; }
};

World random_world(Random& random, double share) {
  World world;
  world.blocked.resize(world.grid.size());
  for (auto& cell : world.blocked) cell = random.unit() < share ? 1 : 0;
  return world;
}

State random_state(Random& random, const Grid& grid) {
  return {{grid.x0_m + random.unit() * grid.width_m(), grid.y0_m + random.unit() * grid.height_m()},
          Heading::from_rad(random.uniform(-pi, pi))};
}

/// How near the path comes to a blocked cell, by samples: 0 inside one.
double nearest_m(const DubinsPath& path, const BlockedCells& cells, double step_m) {
  double nearest = 1e9;
  for (const State& s : sampled(path, step_m)) {
    for (std::size_t i = 0; i < cells.blocked.size(); ++i) {
      if (cells.blocked[i] == 0) continue;
      const Vec2 low = cells.grid.corner(cells.grid.cell_at(i));
      const double side = cells.grid.cell_m;
      const double dx = std::max({low.x - s.position_m.x, 0.0, s.position_m.x - low.x - side});
      const double dy = std::max({low.y - s.position_m.y, 0.0, s.position_m.y - low.y - side});
      nearest = std::min(nearest, std::hypot(dx, dy));
    }
  }
  return nearest;
}

TEST(ClearApproach, APathIsClearWhenItsSamplesComeNearNoObstacle) {
  Random random(1);
  int clear = 0;
  int touching = 0;
  for (int i = 0; i < 1'500; ++i) {
    const World world = random_world(random, 0.04);
    const double r = random.uniform(1.0, 6.0);
    const DubinsPath path =
        shortest_path(random_state(random, world.grid), random_state(random, world.grid), r);
    const double step_m = 0.02;
    const double near_m = nearest_m(path, world.cells(), step_m);
    if (is_clear(path, world.cells(false))) {
      ++clear;
      ASSERT_GT(near_m, 0.0) << i;
    } else {
      ++touching;
      ASSERT_LE(near_m, 0.5 * step_m + 1e-6) << i;
    }
  }
  EXPECT_GT(clear, 200);
  EXPECT_GT(touching, 200);
}

TEST(ClearApproach, TouchingASideOrACornerIsNotClear) {
  World world;
  world.blocked.assign(world.grid.size(), 0);
  world.blocked[world.grid.index({4, 4})] = 1;  // [3, 4.5] x [8, 9.5]
  const auto along = [&](double y) {
    return is_clear(shortest_path({{0.0, y}, {}}, {{9.0, y}, {}}, 1.0), world.cells());
  };
  EXPECT_FALSE(along(8.0));
  EXPECT_FALSE(along(9.5));
  EXPECT_TRUE(along(7.999));
  EXPECT_TRUE(along(9.501));
  // A circle of radius 2 whose topmost point is on the lower side; one that ends at a corner.
  const auto circle_up_to = [&](double top) {
    const State start{{3.7, top - 4.0}, {}};
    return is_clear(shortest_path(start, {{3.7, top}, Heading::from_rad(pi)}, 2.0), world.cells());
  };
  EXPECT_FALSE(circle_up_to(8.0));
  EXPECT_TRUE(circle_up_to(7.999));
}

TEST(ClearApproach, TheWorldsEdgeCountsOnlyWhenItIsBlocked) {
  World world;
  world.blocked.assign(world.grid.size(), 0);
  const DubinsPath out = shortest_path({{0, 10}, {}}, {{60, 10}, {}}, 1.0);
  EXPECT_FALSE(is_clear(out, world.cells(true)));
  EXPECT_TRUE(is_clear(out, world.cells(false)));
}

TEST(ClearApproach, IsTheShortestPathWhereThatIsClearAndAnotherWhereItIsNot) {
  Random random(2);
  int shortest = 0;
  int other = 0;
  int none = 0;
  for (int i = 0; i < 400; ++i) {
    const World world = random_world(random, 0.06);
    const double r = random.uniform(1.0, 3.0);
    const State from = random_state(random, world.grid);
    const State goal = random_state(random, world.grid);
    const auto approach = first_clear_approach(from, goal, r, world.cells());
    if (!approach) {
      ++none;
      EXPECT_FALSE(is_clear(shortest_path(from, goal, r), world.cells()));
      continue;
    }
    EXPECT_TRUE(is_clear(approach->lead, world.cells()));
    EXPECT_TRUE(is_clear(approach->path, world.cells()));
    EXPECT_GT(nearest_m(approach->path, world.cells(), 0.05), 0.0);
    EXPECT_LE(norm(end_of(approach->path).position_m - goal.position_m), 1e-9);
    const double least_m = shortest_length_m(from, goal, r);
    const bool same = approach->length_m() <= least_m * (1.0 + 1e-12) + 1e-12;
    EXPECT_EQ(same, is_clear(shortest_path(from, goal, r), world.cells())) << i;
    ++(same ? shortest : other);
  }
  EXPECT_GT(shortest, 20);
  EXPECT_GT(other, 20);
  EXPECT_GT(none, 20);
}

}  // namespace
}  // namespace fairway
