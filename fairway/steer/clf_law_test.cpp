#include "fairway/steer/clf_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fairway/base/random.hpp"
#include "fairway/steer/steering_flight.hpp"
#include "fairway/steer/testing/dubins_oracle.hpp"

namespace fairway {
namespace {

const State goal{{0.0, 0.0}, Heading::from_rad(pi / 2)};

State pose(double x, double y, double h) { return {{x, y}, Heading::from_rad(h)}; }

TEST(AccommodationCircles, AreARadiusToTheLeftAndRightAndDetermineThePose) {
  Random random(1);
  for (int i = 0; i < 1'000; ++i) {
    const State s = oracle::random_pose(random, 9.0);
    const double r = random.uniform(0.1, 9.0);
    const AccommodationCircles c = accommodation_circles(s, r);
    const double h = s.heading.rad();  // Eq. 2
    EXPECT_NEAR(c.left_m.x, s.position_m.x - r * std::sin(h), 1e-14 * (r + 9));
    EXPECT_NEAR(c.left_m.y, s.position_m.y + r * std::cos(h), 1e-14 * (r + 9));
    EXPECT_NEAR(norm(0.5 * (c.left_m + c.right_m) - s.position_m), 0.0, 1e-14 * (r + 9));
  }
}

TEST(Vote, ElectsTheSmallerNumberTheMoreTheLargerN) {
  for (const double x : {1e-300, 1e-9, 0.5, 1.0, 3.0, 1e9, 1e300}) {
    for (const double y : {1e-300, 1e-9, 0.5, 1.0, 3.0, 1e9, 1e300}) {
      const double low = std::min(x, y);
      double last = 0.0;
      for (const int n : {1, 2, 4, 16, 64}) {
        const double v = vote(x, y, n);
        EXPECT_LE(v, low);
        EXPECT_GE(v, low * std::pow(2.0, -1.0 / n) * (1 - 1e-14));
        EXPECT_GE(v, last);
        EXPECT_EQ(v, vote(y, x, n));
        last = v;
      }
    }
  }
  EXPECT_EQ(vote(0.0, 2.0, 8), 0.0);
  EXPECT_NEAR(vote(2.0, 2.0, 1), 1.0, 1e-15);
}

TEST(ClfLaw, DistancesAreThoseOfTheirEquations) {
  Random random(2);
  for (int i = 0; i < 1'000; ++i) {
    const State s = oracle::random_pose(random, 4.0);
    const double x = s.position_m.x, y = s.position_m.y, h = s.heading.rad();
    const ClfValue of = ClfLaw().value(s, goal, 1.0);
    // Eqs. 3 and 4; in Eq. 3 the second term is y + r cos(theta): it is y_L of Eq. 2.
    EXPECT_NEAR(of.d_ll, std::hypot(x - std::sin(h) + 1.0, y + std::cos(h)), 1e-14);
    EXPECT_NEAR(of.d_rr, std::hypot(x + std::sin(h) - 1.0, y - std::cos(h)), 1e-14);
    EXPECT_LE(of.v, of.v_attract);
  }
  EXPECT_NEAR(ClfLaw().value(goal, goal, 1.0).v, 0.0, 1e-15);
}

TEST(ClfLaw, IsTheSameAtAnyPlaceDirectionAndRadius) {
  Random random(3);
  for (int i = 0; i < 1'000; ++i) {
    const State s = pose(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-pi, pi));
    const double r = random.uniform(0.1, 50.0);
    const double turn = random.uniform(-pi, pi);
    const Vec2 move{random.uniform(-9, 9), random.uniform(-9, 9)};
    const auto moved = [&](const State& of) {
      const Vec2 u{std::cos(turn), std::sin(turn)};
      return State{move + r * (of.position_m.x * u + of.position_m.y * left_of(u)),
                   Heading::from_rad(of.heading.rad() + turn)};
    };
    const ClfValue here = ClfLaw().value(s, goal, 1.0);
    const ClfValue there = ClfLaw().value(moved(s), moved(goal), r);
    ASSERT_NEAR(there.d_ll, here.d_ll, 1e-12 * (1 + 9 / r));
    ASSERT_NEAR(there.v, here.v, 1e-11 * (1 + 9 / r));
    ClfLaw a;
    ClfLaw b;
    ASSERT_NEAR(b.curvature_per_m(moved(s), moved(goal), r, 0.01 * r) * r,
                a.curvature_per_m(s, goal, 1.0, 0.01), 1e-9 * (1 + 9 / r));
  }
}

TEST(ClfLaw, TheSmallerDistanceNeverGrowsOnceNothingRepels) {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const State from = pose(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-pi, pi));
    ClfLaw law;
    State s = from;
    double last = 1e9;
    bool over = false;
    for (int k = 0; k < 2'000; ++k) {
      const ClfValue of = law.value(s, goal, 1.0);
      const double nearest = std::min(of.d_ll, of.d_rr);
      if (over && nearest > 0.02) {
        // A step may begin approaching and end past the circle's side: 2 step^2 / distance.
        ASSERT_LE(nearest, last + 2.1e-4 / last) << "start " << i << " step " << k;
      }
      last = nearest;
      over = over || !(of.repels_left || of.repels_right);
      const double per_m = law.curvature_per_m(s, goal, 1.0, 0.01);
      ASSERT_LE(std::abs(per_m), 1.0);
      s = driven(s, 0.01, per_m);
    }
  }
}

TEST(ClfLaw, ReachesTheGoalFromEverywhereTried) {
  Random random(5);
  int shortest = 0;
  constexpr int starts = 2'000;
  for (int i = 0; i < starts; ++i) {
    const double r = random.uniform(0.5, 30.0);
    const State from =
        pose(r * random.uniform(-6, 6), r * random.uniform(-6, 6), random.uniform(-pi, pi));
    ClfLaw law;
    const SteeringFlight flight = fly(law, from, goal, r, steering_options(from, goal, r));
    ASSERT_TRUE(flight.converged) << i;
    ASSERT_LE(norm(flight.end.position_m), 0.02 * r);
    const double least = shortest_length_m(from, goal, r);
    ASSERT_GE(flight.length_m, least - 0.1 * r);
    shortest += flight.length_m <= least + 0.05 * r ? 1 : 0;
  }
  // Not "all paths are the shortest", but most are.
  EXPECT_GT(shortest, starts * 3 / 4);
  EXPECT_LT(shortest, starts * 19 / 20);
}

}  // namespace
}  // namespace fairway
