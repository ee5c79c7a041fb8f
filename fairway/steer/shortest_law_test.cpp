#include "fairway/steer/shortest_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fairway/base/random.hpp"
#include "fairway/steer/dubins_oracle.hpp"
#include "fairway/steer/steering_flight.hpp"

namespace fairway {
namespace {

State pose(double x, double y, double h) { return {{x, y}, Heading::from_rad(h)}; }

ShortestLaw law_for(double r, const SteeringOptions& options) {
  return ShortestLaw({options.tolerance, 0.02 * r});
}

TEST(ShortestLaw, ReachesTheGoalByNoMoreThanTheShortestLength) {
  // 200,000 poses, in boxes of three sizes, some where paths tie or turns vanish.
  for (const double size : {1.0, 4.0, 40.0}) {
    Random random(1);
    const int count = size > 10.0 ? 20'000 : 90'000;
    for (int i = 0; i < count; ++i) {
      const double r = i % 2 == 0 ? 1.0 : random.uniform(0.5, 30.0);
      State from = oracle::random_pose(random, size * r);
      State goal = oracle::random_pose(random, size * r);
      if (i % 7 == 0) goal.heading = from.heading;
      if (i % 11 == 0) goal.heading = from.heading.opposite();
      if (i % 13 == 0)
        goal.position_m = from.position_m - random.uniform(0, 3) * r * from.heading.unit();
      if (i % 17 == 0)
        goal.position_m = from.position_m + random.uniform(0, 3) * r * from.heading.unit();
      SteeringOptions options = steering_options(from, goal, r);
      options.step_m = 0.03 * r;
      ShortestLaw law = law_for(r, options);
      const SteeringFlight flight = fly(law, from, goal, r, options);
      ASSERT_TRUE(flight.converged) << i << " size " << size;
      ASSERT_LE(flight.length_m, shortest_length_m(from, goal, r) + 0.1 * r)
          << i << " size " << size << ' ' << flight.word;
    }
  }
}

TEST(ShortestLaw, FollowsTheFirstControlOfTheShortestPath) {
  Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    const State from = oracle::random_pose(random, 6.0);
    const State goal = oracle::random_pose(random, 6.0);
    const DubinsPath path = shortest_path(from, goal, 1.0);
    ShortestLaw law({{0.01, 0.01}, 0.01});
    const double per_m = law.curvature_per_m(from, goal, 1.0, 1e-3);
    if (path.part_m[0] > 1e-3) {
      ASSERT_EQ(per_m, turn_of(path.word, 0));
    }
    ASSERT_LE(std::abs(per_m), 1.0);
  }
}

TEST(ShortestLaw, DoesNotHesitateAtATie) {
  // Straight behind: turning left is as long as turning right. Noise of the position tells one from
  // the other at random in every step; the vehicle must make up its mind all the same.
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const double r = 10.0;
    const State from = pose(0, 0, 0);
    const State goal = pose(-random.uniform(3.0, 80.0), 0, pi);
    SteeringOptions options = steering_options(from, goal, r);
    ShortestLaw law({options.tolerance, 0.05 * r});
    int changes = 0;
    double last = 0.0;
    const auto watch = [&](const State& s) {
      if (law.path() && law.path()->part_m[0] > 0.2 * r) {  // not what corrects the noise
        const double now = turn_at(*law.path(), 0.0);
        changes += now * last < 0.0 ? 1 : 0;
        last = now != 0.0 ? now : last;
      }
      return State{s.position_m + 1e-4 * r * Vec2{random.normal(), random.normal()}, s.heading};
    };
    const SteeringFlight flight = fly(law, from, goal, r, options, Track::none, watch);
    ASSERT_TRUE(flight.converged) << i;
    ASSERT_LE(changes, 12) << i << ' ' << flight.word;
    ASSERT_LE(flight.length_m, shortest_length_m(from, goal, r) + 8.0 * r);
  }
}

TEST(ShortestLaw, ReachesTheGoalInNoise) {
  Random random(4);
  int direct = 0;
  constexpr int starts = 3'000;
  for (int i = 0; i < starts; ++i) {
    const double r = 20.0;
    const State from = oracle::random_pose(random, 8.0 * r);
    const State goal = oracle::random_pose(random, 8.0 * r);
    SteeringOptions options = steering_options(from, goal, r);
    options.tolerance = {0.05 * r, 0.05};
    options.length_limit_m *= 3.0;
    ShortestLaw law({options.tolerance, 0.02 * r});
    const auto gust = [&](const State& s) {
      return State{s.position_m + 5e-4 * r * Vec2{random.normal(), random.normal()},
                   Heading::from_rad(s.heading.rad() + 5e-4 * random.normal())};
    };
    const SteeringFlight flight = fly(law, from, goal, r, options, Track::none, gust);
    ASSERT_TRUE(flight.converged) << i;
    direct += flight.length_m <= shortest_length_m(from, goal, r) + 0.3 * r ? 1 : 0;
  }
  EXPECT_GT(direct, starts * 8 / 10);
}

TEST(ShortestLaw, CatchesAGoalThatMovesMoreSlowly) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const double r = 20.0;
    const State from = oracle::random_pose(random, 10.0 * r);
    State goal = oracle::random_pose(random, 10.0 * r);
    const double speed = random.uniform(0.0, 0.5);  // of the vehicle's, along the goal's heading
    const PoseTolerance tolerance{0.05 * r, 0.05};
    ShortestLaw law({tolerance, 0.02 * r});
    State s = from;
    const double step_m = 0.01 * r;
    bool caught = false;
    for (int k = 0; k < 20'000 && !caught; ++k) {
      s = driven(s, step_m, law.curvature_per_m(s, goal, r, step_m));
      goal = driven(goal, speed * step_m, 0.0);
      caught = tolerance.holds(s, goal);
    }
    ASSERT_TRUE(caught) << i << " speed " << speed;
  }
}

TEST(ShortestLaw, WhatIsLeftFallsByTheStep) {
  Random random(6);
  for (int i = 0; i < 3'000; ++i) {
    const State from = oracle::random_pose(random, 6.0);
    const State goal = oracle::random_pose(random, 6.0);
    const SteeringOptions options = steering_options(from, goal, 1.0);
    ShortestLaw law = law_for(1.0, options);
    State s = from;
    double left = shortest_length_m(from, goal, 1.0);
    while (!options.tolerance.holds(s, goal)) {
      s = driven(s, options.step_m, law.curvature_per_m(s, goal, 1.0, options.step_m));
      const double now = law.path()->length_m();
      ASSERT_LE(now, left + 0.02 + 1e-3) << i;  // the tie, and a switch within a step
      left = now - options.step_m;
    }
  }
}

}  // namespace
}  // namespace fairway
