#include "fairway/inclusion/convex_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

bool holds(const ConvexSet& set, Vec2 p, double slack) {
  const auto corners = set.corners();
  if (corners.size() == 1) return std::hypot(p.x - corners[0].x, p.y - corners[0].y) <= slack;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i];
    const Vec2 b = corners[(i + 1) % corners.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double left = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    if (left < -slack * length) return false;
  }
  return true;
}

std::vector<Vec2> some_points(Random& random, std::size_t n) {
  std::vector<Vec2> points(n);
  const bool flat = random.below(4) == 0;
  for (Vec2& p : points) {
    p = {random.uniform(-3.0, 3.0), flat ? 1.0 : random.uniform(-3.0, 3.0)};
    if (random.below(5) == 0) p = points[random.below(n)];
  }
  return points;
}

TEST(ConvexSet, AHullHoldsItsPointsAndNoSimpleOneIsWider) {
  Random random(1);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Vec2> points = some_points(random, 1 + random.below(60));
    const std::vector<Vec2> given = points;
    const ConvexSet hull = ConvexSet::hull(points);
    ASSERT_LE(hull.corners().size(), ConvexSet::simple);
    for (const Vec2 p : given) EXPECT_TRUE(holds(hull, p, 1e-12));
    if (given.size() > 10) continue;
    for (const Vec2 corner : hull.corners()) {
      EXPECT_TRUE(std::any_of(given.begin(), given.end(), [&](Vec2 p) { return p == corner; }));
    }
  }
}

TEST(ConvexSet, ABoxCutsOutWhatLiesInIt) {
  Random random(2);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Vec2> points = some_points(random, 3 + random.below(20));
    const ConvexSet set = ConvexSet::hull(points);
    const ConvexSet cut = set.within({{-1.0, -1.0}, {1.0, 1.5}});
    for (const Vec2 p : cut.corners()) {
      EXPECT_TRUE(holds(set, p, 1e-9));
      EXPECT_TRUE(p.x >= -1.0 - 1e-12 && p.x <= 1.0 + 1e-12 && p.y >= -1.0 - 1e-12 &&
                  p.y <= 1.5 + 1e-12);
    }
    for (int k = 0; k < 20; ++k) {
      const Vec2 p{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.5)};
      if (holds(set, p, -1e-9)) {
        EXPECT_FALSE(cut.empty());
        EXPECT_TRUE(holds(cut, p, 1e-9));
      }
    }
  }
}

TEST(ConvexSet, ASumHoldsAllSums) {
  Random random(3);
  for (int round = 0; round < 1000; ++round) {
    std::vector<Vec2> points = some_points(random, 1 + random.below(20));
    std::vector<Vec2> steps = some_points(random, 1 + random.below(12));
    const ConvexSet set = ConvexSet::hull(points);
    const ConvexSet all = sum(set, ConvexSet::hull(steps));
    for (const Vec2 p : points) {
      for (const Vec2 step : steps) EXPECT_TRUE(holds(all, p + step, 1e-12));
    }
  }
}

}  // namespace
}  // namespace fairway
