#include "fairway/steer/shortest_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/steer/steering_flight.hpp"
#include "fairway/steer/testing/dubins_oracle.hpp"

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
      ASSERT_LE(flight.length_m, shortest_length_m(from, goal, r) + 0.05 * r)
          << i << " size " << size << ' ' << flight.word;
    }
  }
}

TEST(ShortestLaw, DrivesNoExtraLoopWithShortSteps) {
  // Among the goals: last turns of half a circle and a little more, where a path of three turns is
  // nearly as short; with a turn in it that is shorter than a step.
  Random random(9);
  for (int i = 0; i < 12'000; ++i) {
    const State from = oracle::random_pose(random, 6.0);
    State goal = oracle::random_pose(random, 6.0);
    if (i % 2 == 0) {
      const double turn = random.uniform(0.0, two_pi);
      goal = driven(driven(from, turn, i % 4 == 0 ? 1.0 : -1.0), random.uniform(0.0, 3.0), 0.0);
      goal = driven(goal, pi + random.uniform(-0.02, 0.02), i % 8 < 4 ? 1.0 : -1.0);
    }
    SteeringOptions options = steering_options(from, goal, 1.0);
    options.step_m = std::array{0.005, 0.01, 0.02}[static_cast<std::size_t>(i % 3)];
    ShortestLaw law = law_for(1.0, options);
    const SteeringFlight flight = fly(law, from, goal, 1.0, options);
    ASSERT_TRUE(flight.converged) << i;
    ASSERT_LE(flight.length_m, shortest_length_m(from, goal, 1.0) + 0.05)
        << i << ' ' << flight.word;
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
  // Straight behind: turning left is as long as turning right. Noise of the position favours one or
  // the other at random in every step; the vehicle must still decide.
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
        const double now = turn_of(law.path()->word, 0);
        changes += now * last < 0.0 ? 1 : 0;
        last = now != 0.0 ? now : last;
      }
      return State{s.position_m + 1e-4 * r * Vec2{random.normal(), random.normal()}, s.heading};
    };
    const SteeringFlight flight =
        fly(law, from, goal, r, options, Track::none, {.disturbed = watch});
    ASSERT_TRUE(flight.converged) << i;
    ASSERT_LE(changes, 12) << i << ' ' << flight.word;
    ASSERT_LE(flight.length_m, shortest_length_m(from, goal, r) + 8.0 * r);
  }
}

TEST(ShortestLaw, ReachesTheGoalWithNoise) {
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
    const SteeringFlight flight =
        fly(law, from, goal, r, options, Track::none, {.disturbed = gust});
    ASSERT_TRUE(flight.converged) << i;
    direct += flight.length_m <= shortest_length_m(from, goal, r) + 0.3 * r ? 1 : 0;
  }
  EXPECT_GT(direct, starts * 99 / 100);
}

TEST(ShortestLaw, CatchesAGoalThatMovesMoreSlowly) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const double r = 20.0;
    const State from = oracle::random_pose(random, 10.0 * r);
    const State goal = oracle::random_pose(random, 10.0 * r);
    const double speed = random.uniform(0.0, 0.5);  // of the vehicle's, along the goal's heading
    const SteeringOptions options{0.01 * r, {0.05 * r, 0.05}, 200.0 * r};
    ShortestLaw law({options.tolerance, 0.02 * r});
    const auto moving = [&](double driven_m) { return driven(goal, speed * driven_m, 0.0); };
    const bool caught = fly(law, from, goal, r, options, Track::none, {.goal = moving}).converged;
    ASSERT_TRUE(caught) << i << " speed " << speed;
  }
}

TEST(ShortestLaw, RefusesStepsThatItsToleranceDoesNotCover) {
  const State goal = pose(5, 1, 2);
  const auto steer = [&](PoseTolerance tolerance, double step_m) {
    return ShortestLaw({tolerance, 0.1}).curvature_per_m(pose(0, 0, 0), goal, 2.0, step_m);
  };
  // step / 2 + step^2 / (2 r) = 0.0525 and step / (2 r) = 0.025
  EXPECT_NO_THROW((void)steer({0.0526, 0.0251}, 0.1));
  EXPECT_THROW((void)steer({0.0525, 0.0251}, 0.1), PreconditionViolation);
  EXPECT_THROW((void)steer({0.0526, 0.025}, 0.1), PreconditionViolation);
  EXPECT_THROW((void)steer({0.1, 0.1}, 0.0), PreconditionViolation);
  EXPECT_THROW((void)steer({0.1, 0.1}, std::nan("")), PreconditionViolation);
}

TEST(ShortestLaw, ConvergesWithAToleranceThatJustCoversTheStep) {
  Random random(8);
  for (int i = 0; i < 4'000; ++i) {
    const State from = oracle::random_pose(random, 6.0);
    const State goal = oracle::random_pose(random, 6.0);
    SteeringOptions options = steering_options(from, goal, 1.0);
    options.step_m = random.uniform(0.01, 0.3);
    const double half = 0.5 * options.step_m;
    options.tolerance = {1.0001 * options.step_m * (0.5 + half), 1.0001 * half};
    ShortestLaw law({options.tolerance, 0.02});
    EXPECT_TRUE(fly(law, from, goal, 1.0, options).converged) << i << " step " << options.step_m;
  }
}

TEST(ShortestLaw, TheRestOfThePathFallsByTheStep) {
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
      // Less four times the distance by which joins within steps make the end miss the goal.
      ASSERT_LE(now, left + 2.01 * options.step_m * options.step_m) << i;
      left = now - options.step_m;
    }
  }
}

}  // namespace
}  // namespace fairway
