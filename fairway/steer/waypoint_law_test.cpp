#include "fairway/steer/waypoint_law.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/steer/testing/dubins_oracle.hpp"
#include "fairway/steer/testing/heap_uses.hpp"

namespace fairway {
namespace {

constexpr double r = 20.0;
constexpr double step_m = 0.01 * r;
constexpr PoseTolerance tolerance{0.02 * r, 0.02};

WaypointLaw<ShortestLaw> shortest_law(const WaypointOptions& options) {
  return shortest_waypoint_law(options, 0.02 * r);
}

/// At least `apart` from one to the next.
std::vector<State> random_course(Random& random, std::size_t count, double apart_m, double box_m) {
  std::vector<State> course;
  while (course.size() < count) {
    const State s = oracle::random_pose(random, box_m);
    if (course.empty() || norm(s.position_m - course.back().position_m) >= apart_m) {
      course.push_back(s);
    }
  }
  return course;
}

TEST(WaypointLaw, ReachesEveryWaypointInOrderByTheShortestPaths) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const double box = std::array{2.0, 6.0, 30.0}[i % 3];
    const std::vector<State> course = random_course(random, 8, 0.0, box * r);
    const State from = oracle::random_pose(random, box * r);
    const WaypointFlight flight =
        follow_waypoints(shortest_law({tolerance}), from, course, r, step_m);
    ASSERT_TRUE(flight.converged) << i;
    ASSERT_EQ(flight.legs.size(), course.size());
    for (std::size_t k = 0; k < course.size(); ++k) {
      const WaypointLeg& leg = flight.legs[k];
      EXPECT_TRUE(tolerance.holds(leg.end, course[k])) << i << ' ' << k;
      EXPECT_EQ(leg.begin, k == 0 ? from : flight.legs[k - 1].end);
      EXPECT_LE(leg.length_m, leg.shortest_m + 0.05 * r) << i << ' ' << k;
      EXPECT_EQ(leg.extra_turns, 0);
    }
  }
}

TEST(WaypointLaw, DrivesTheSumOfTheShortestLengthsWhereTheyDoNotJump) {
  // Waypoints 4 r apart and more: there the length of a shortest path is continuous. A leg begins
  // within the tolerance of a waypoint, from where it may be that much longer, times a factor.
  Random random(2);
  double worst = 0.0;
  for (int i = 0; i < 400; ++i) {
    std::vector<State> course = random_course(random, 9, 4.0 * r, 30.0 * r);
    const State from = course.front();
    course.erase(course.begin());
    double sum_m = 0.0;
    for (std::size_t k = 0; k < course.size(); ++k) {
      sum_m += shortest_length_m(k == 0 ? from : course[k - 1], course[k], r);
    }
    const WaypointFlight flight =
        follow_waypoints(shortest_law({tolerance}), from, course, r, step_m);
    ASSERT_TRUE(flight.converged);
    const double off = std::abs(flight.length_m - sum_m) / (r * static_cast<double>(course.size()));
    worst = std::max(worst, off);
  }
  EXPECT_LE(worst, 0.1);
}

TEST(WaypointLaw, ThePapersLawFollowsThemToo) {
  Random random(3);
  int longer = 0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<State> course = random_course(random, 6, 0.0, 8.0 * r);
    const State from = oracle::random_pose(random, 8.0 * r);
    const WaypointFlight flight =
        follow_waypoints(WaypointLaw<ClfLaw>(ClfLaw(), {tolerance}), from, course, r, step_m);
    ASSERT_TRUE(flight.converged) << i;
    for (std::size_t k = 0; k < course.size(); ++k) {
      EXPECT_TRUE(tolerance.holds(flight.legs[k].end, course[k]));
      longer += flight.legs[k].length_m > flight.legs[k].shortest_m + 0.1 * r ? 1 : 0;
    }
  }
  EXPECT_GT(longer, 0);
}

/// Gusts in every step, of the place and of the heading.
struct Noise {
  double size;  ///< of r, and of a radian
  Random random;
  State operator()(const State& s) {
    return {s.position_m + size * r * Vec2{random.normal(), random.normal()},
            Heading::from_rad(s.heading.rad() + size * random.normal())};
  }
};

struct NoisyLegs {
  int legs = 0;
  int extra_turns = 0;
  int passed = 0;
};

NoisyLegs follow_in_noise(const WaypointOptions& options, double size) {
  Random random(4);
  NoisyLegs sum;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const std::vector<State> course = random_course(random, 6, 0.0, 8.0 * r);
    const WaypointFlight flight =
        follow_waypoints(shortest_law(options), oracle::random_pose(random, 8.0 * r), course, r,
                         step_m, Track::none, Noise{size, Random(i)});
    EXPECT_TRUE(flight.converged) << i;
    for (std::size_t k = 0; k < flight.legs.size(); ++k) {
      const WaypointLeg& leg = flight.legs[k];
      EXPECT_TRUE(leg.reached ? options.reached.holds(leg.end, course[k])
                              : options.passed.holds(leg.end, course[k]));
      ++sum.legs;
      sum.extra_turns += leg.extra_turns;
      sum.passed += leg.reached ? 0 : 1;
    }
  }
  return sum;
}

TEST(WaypointLaw, WithNoiseEveryWaypointIsReachedWithFewExtraLoops) {
  const NoisyLegs sum = follow_in_noise({{0.05 * r, 0.05}}, 5e-4);
  EXPECT_EQ(sum.legs, 1200);
  EXPECT_EQ(sum.passed, 0);
  EXPECT_LT(sum.extra_turns, 12);
}

TEST(WaypointLaw, WithMoreNoisePassingNearEnoughAvoidsTheLoops) {
  const PoseTolerance reached{0.05 * r, 0.05};
  EXPECT_GT(follow_in_noise({reached}, 2e-3).extra_turns, 120);
  const NoisyLegs sum = follow_in_noise({reached, {0.25 * r, 0.25}}, 2e-3);
  EXPECT_EQ(sum.legs, 1200);
  EXPECT_GT(sum.passed, 60);
  EXPECT_LT(sum.extra_turns, 12);
}

TEST(WaypointLaw, IsLatchedWhileWaypointsMoveAndTheVehicleIsPushed) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    std::vector<State> course = random_course(random, 5, 0.0, 10.0 * r);
    const WaypointOptions options{{0.05 * r, 0.05}, {0.1 * r, 0.1}};
    WaypointLaw<ShortestLaw> law = shortest_law(options);
    State s = oracle::random_pose(random, 10.0 * r);
    const double speed = random.uniform(0.0, 0.4);  // of the vehicle's, along their headings
    std::size_t next = 0;
    for (int k = 0; k < 100'000 && law.next() < course.size(); ++k) {
      const double per_m = law.curvature_per_m(s, course, r, step_m);
      ASSERT_GE(law.next(), next);
      for (std::size_t done = next; done < law.next(); ++done) {
        ASSERT_TRUE(options.passed.holds(s, course[done])) << i;
      }
      next = law.next();
      s = driven(s, step_m, per_m);
      if (k % 997 == 0) s.position_m = s.position_m + 0.5 * r * Vec2{random.normal(), 0.0};
      for (State& waypoint : course) waypoint = driven(waypoint, speed * step_m, 0.0);
    }
    EXPECT_EQ(law.next(), course.size()) << i;
  }
}

TEST(WaypointLaw, AWaypointMetTwiceInARowIsDoneAtOnce) {
  const State a{{50.0, 10.0}, Heading::from_rad(1.0)};
  const std::vector<State> course{a, a, a};
  const WaypointFlight flight = follow_waypoints(shortest_law({tolerance}), {}, course, r, step_m);
  ASSERT_TRUE(flight.converged);
  EXPECT_GT(flight.legs[0].length_m, 0.0);
  EXPECT_EQ(flight.legs[1].length_m, 0.0);
  EXPECT_EQ(flight.legs[2].length_m, 0.0);
  EXPECT_TRUE(follow_waypoints(shortest_law({tolerance}), {}, {}, r, step_m).converged);
}

TEST(WaypointLaw, AStepUsesNoHeap) {
  Random random(6);
  const std::vector<State> course = random_course(random, 20, 0.0, 8.0 * r);
  WaypointLaw<ShortestLaw> shortest = shortest_law({tolerance});
  WaypointLaw<ClfLaw> clf(ClfLaw(), {tolerance});
  State a;
  State b;
  const std::size_t before = testing::heap_uses();
  for (int k = 0; k < 20'000; ++k) {
    a = driven(a, step_m, shortest.curvature_per_m(a, course, r, step_m));
    b = driven(b, step_m, clf.curvature_per_m(b, course, r, step_m));
  }
  EXPECT_EQ(testing::heap_uses(), before);
  EXPECT_GT(shortest.next(), 0U);
  EXPECT_GT(clf.next(), 0U);
}

}  // namespace
}  // namespace fairway
