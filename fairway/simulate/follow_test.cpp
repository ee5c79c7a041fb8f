// Flights followed beyond their first goal cell, exact and sampled.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/sampled_flight.hpp"
#include "fairway/simulate/testing/circuit_plan.hpp"

namespace fairway {
namespace {

using testing::circuit_plan;
using testing::walled_circuit_plan;

std::vector<State> starts(std::uint64_t seed, int count) {
  Random random(seed);
  std::vector<State> all;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-4.0, 132.0);  // some beyond the edge
    all.push_back({{x, random.uniform(0.0, 128.0)}, Heading::from_rad(random.uniform(-pi, pi))});
  }
  return all;
}

double length_of(const std::vector<FlightSegment>& pieces) {
  double length_m = 0.0;
  for (const FlightSegment& piece : pieces) length_m += piece.length_m;
  return length_m;
}

bool same(const FlightResult& a, const FlightResult& b) {
  return a.outcome == b.outcome && a.time_s == b.time_s && a.length_m == b.length_m;
}

/// Turns of pieces, counted another way: from the list of what is not straight.
Turning turning_by_hand(const std::vector<FlightSegment>& pieces) {
  Turning turning;
  std::vector<double> turns;
  for (const FlightSegment& piece : pieces) {
    turning.length_m += piece.length_m;
    turning.turned_rad += std::abs(piece.curvature_per_m * piece.length_m);
    if (piece.curvature_per_m != 0.0) turns.push_back(piece.curvature_per_m);
  }
  for (std::size_t i = 1; i < turns.size(); ++i) {
    turning.reversals += std::signbit(turns[i]) != std::signbit(turns[i - 1]) ? 1 : 0;
  }
  return turning;
}

void expect_near(const Turning& a, const Turning& b) {
  EXPECT_NEAR(a.length_m, b.length_m, 1e-7);
  EXPECT_NEAR(a.turned_rad, b.turned_rad, 1e-7);
  EXPECT_EQ(a.reversals, b.reversals);
}

TEST(Follow, IsThePlainFlightUpToTheFirstGoalCell) {
  for (const Plan& plan : {circuit_plan(), circuit_plan(-1.0), walled_circuit_plan()}) {
    const ExactFlights flights(plan);
    int reach = 0;
    for (const State& start : starts(81, 400)) {
      const Flight plain = flights.record(start);
      const Flight followed = flights.follow_on(start, {.length_m = 300.0});
      ASSERT_TRUE(same(plain.result, followed.result));
      ASSERT_TRUE(same(plain.result, flights.fly(start)));
      EXPECT_EQ(plain.onward, Onward{});
      if (plain.result.outcome != Outcome::reach) {
        EXPECT_EQ(followed.onward, Onward{});
        continue;
      }
      ++reach;
      for (std::size_t i = 0; i + 1 < plain.segments.size(); ++i) {
        ASSERT_EQ(plain.segments[i].start.position_m, followed.segments[i].start.position_m);
        ASSERT_EQ(plain.segments[i].length_m, followed.segments[i].length_m);
      }
    }
    EXPECT_GT(reach, 300);
  }
}

TEST(Follow, GoesOnForTheLengthAskedAndNoFarther) {
  const Plan plan = circuit_plan();
  const ExactFlights flights(plan);
  for (const State& start : starts(82, 100)) {
    const Flight flight = flights.follow_on(start, {.length_m = 37.0});
    if (flight.result.outcome != Outcome::reach) continue;
    ASSERT_EQ(flight.onward.after, After::follow);
    EXPECT_NEAR(flight.onward.length_m, flight.result.length_m + 37.0, 1e-9);
    EXPECT_NEAR(length_of(flight.segments), flight.onward.length_m, 1e-6);
    EXPECT_NEAR(flight.onward.time_s, flight.onward.length_m / 10.0, 1e-9);
    const Flight timed = flights.follow_on(start, {.time_s = 3.7});
    EXPECT_NEAR(timed.onward.length_m, flight.onward.length_m, 1e-9);
  }
}

TEST(Follow, TellsOfAWallBeyondTheFirstGoalCell) {
  const Plan plan = walled_circuit_plan();
  const ExactFlights flights(plan);
  const SampledFlights sampled(plan, {});
  const State start{{104.0, 50.0}, Heading::from_rad(pi / 2)};  // on the circuit, far from the wall
  const Flight flight = flights.follow_on(start, {.length_m = 300.0});
  EXPECT_EQ(flight.result.outcome, Outcome::reach);
  ASSERT_EQ(flight.onward.after, After::collide);
  EXPECT_NEAR(end_of(flight).position_m.x, 24.0, 3.0);
  EXPECT_NEAR(end_of(flight).position_m.y, 66.0, 1e-6);  // the wall's upper side
  const Flight by_steps = sampled.follow_on(start, 0, {.length_m = 300.0}).flight;
  EXPECT_EQ(by_steps.onward.after, After::collide);
  EXPECT_NEAR(by_steps.onward.length_m, flight.onward.length_m, 2.0);
  // Followed to just before it, the wall is not met.
  const double short_m = flight.onward.length_m - flight.result.length_m - 0.5;
  EXPECT_EQ(flights.follow_on(start, {.length_m = short_m}).onward.after, After::follow);
}

TEST(Follow, LeavesTheResultOfAnySampledLawAsItIs) {
  const Plan plan = walled_circuit_plan();
  for (int k = 0; k < 4; ++k) {
    SampledOptions options;
    if (k == 1) options.law = SaturatedProportional{1.5};
    if (k == 2) options.law = CustomLaw([](const Measurement& m) { return m.heading_error_rad; });
    options.position_noise_m = k > 0 ? 0.5 : 0.0;
    options.heading_noise_rad = k > 0 ? 0.05 : 0.0;
    options.gust_mps = k > 1 ? 1.0 : 0.0;
    if (k == 3) options.wind_mps = {3.0, -1.0};
    const SampledFlights flights(plan, options);
    std::size_t i = 0;
    int collide = 0;
    for (const State& start : starts(83, 60)) {
      const SampledFlight followed = flights.follow_on(start, i, {.length_m = 200.0});
      ASSERT_TRUE(same(followed.flight.result, flights.fly(start, i))) << k << " " << i;
      collide += followed.flight.onward.after == After::collide ? 1 : 0;
      if (followed.flight.onward.after == After::follow) {
        EXPECT_NEAR(followed.flight.onward.length_m, followed.flight.result.length_m + 200.0, 1e-6);
        EXPECT_NEAR(length_of(followed.flight.segments), followed.flight.onward.length_m, 1e-6);
      }
      ++i;
    }
    EXPECT_GT(collide, 10) << k;
  }
}

TEST(Follow, TendsToTheExactFlightAsTheControlPeriodShrinks) {
  const Plan plan = circuit_plan();
  const ExactFlights exact(plan);
  std::vector<double> off_m;
  for (const double period_s : {0.04, 0.01, 0.0025}) {
    SampledOptions options;
    options.control_period_s = period_s;
    const SampledFlights sampled(plan, options);
    double sum_m = 0.0;
    for (int k = 0; k < 12; ++k) {
      const double at = two_pi * k / 12.0;
      const State start{testing::circuit_middle + 47.0 * Vec2{std::cos(at), std::sin(at)},
                        Heading::from_rad(at + pi / 2)};
      const Vec2 a = end_of(exact.follow_on(start, {.length_m = 150.0})).position_m;
      const Vec2 b = end_of(sampled.follow_on(start, 0, {.length_m = 150.0}).flight).position_m;
      sum_m += norm(a - b);
    }
    off_m.push_back(sum_m / 12.0);
  }
  EXPECT_LT(off_m[1], 0.6 * off_m[0]);
  EXPECT_LT(off_m[2], off_m[1]);
  EXPECT_LT(off_m[2], 0.05);
}

TEST(Follow, FliesTheCellsOfAPathByTheLawItself) {
  Plan plan = circuit_plan();
  SampledOptions options;
  options.law = CustomLaw([](const Measurement&) { return 0.0; });
  const State start{{104.5, 64.0}, Heading::from_rad(pi / 2)};
  const SampledFlight flight =
      SampledFlights(plan, options).follow_on(start, 0, {.length_m = 20.0});
  EXPECT_EQ(flight.flight.turning.turned_rad, 0.0);  // Eq. 8: bang-bang in the buffer alone
  plan.record.mission = GoalMission{{64.0, 64.0}, {}};
  EXPECT_GT(SampledFlights(plan, options)
                .follow_on(start, 0, {.length_m = 20.0})
                .flight.turning.turned_rad,
            0.0);
}

TEST(Follow, EndsByTimeWhereTheWindHoldsTheVehicle) {
  Plan plan = circuit_plan();
  for (float& heading : plan.heading_rad) heading = 0.0F;
  SampledOptions options;
  options.wind_mps = {-10.0, 0.0};  // as fast as the vehicle
  const SampledFlight flight =
      SampledFlights(plan, options)
          .follow_on({{104.0, 64.0}, Heading{}}, 0, {.length_m = 50.0, .time_s = 20.0});
  EXPECT_EQ(flight.flight.onward.after, After::follow);
  EXPECT_NEAR(flight.flight.onward.time_s, 20.0, 1e-9);
}

TEST(Turning, IsThatOfThePiecesWhetherTheyAreKeptOrNot) {
  const Plan plan = walled_circuit_plan();
  const ExactFlights flights(plan);
  const SampledFlights calm(plan, {.law = SaturatedProportional{2.0}, .heading_noise_rad = 0.05});
  std::size_t i = 0;
  for (const State& start : starts(84, 200)) {
    const Flight flight = flights.record(start);
    EXPECT_EQ(flight.turning, flights.measure(start).turning);
    EXPECT_TRUE(same(flight.result, flights.measure(start).result));
    expect_near(flight.turning, turning_by_hand(flight.segments));
    if (flight.result.outcome != Outcome::trapped) {
      EXPECT_NEAR(flight.turning.length_m, flight.result.length_m, 1e-5);
    }
    const Flight onward = flights.follow_on(start, {.length_m = 100.0});
    expect_near(onward.turning, turning_by_hand(onward.segments));
    if (i % 5 == 0) {
      const Flight steered = calm.record(start, i).flight;
      EXPECT_EQ(steered.turning, calm.measure(start, i).turning);
      EXPECT_NEAR(steered.turning.turned_rad, turning_by_hand(steered.segments).turned_rad, 1e-6);
    }
    ++i;
  }
}

TEST(Turning, CountsChangesOfDirectionThroughStraightPieces) {
  Turning turning;
  for (const double turn : {0.0, 0.3, 0.2, 0.0, -0.1, 0.0, 0.0, -0.4, 0.5}) turning.add(turn, 2.0);
  EXPECT_EQ(turning.reversals, 2U);
  EXPECT_NEAR(turning.turned_rad, 1.5, 1e-15);
  EXPECT_EQ(turning.length_m, 18.0);
}

TEST(Turning, OfAVehicleInWindIsItsOwnNotItsTracks) {
  Plan plan = circuit_plan();
  for (float& heading : plan.heading_rad) heading = 0.0F;
  plan.region.assign(plan.grid.size(), Region::free);
  SampledOptions options;
  options.wind_mps = {0.0, 3.0};
  const State start{{10.0, 20.0}, Heading::from_rad(-0.7)};
  const Flight flight = SampledFlights(plan, options).measure(start, 0);
  EXPECT_NEAR(flight.turning.turned_rad, 0.7, 1e-9);
  EXPECT_EQ(flight.turning.reversals, 0U);
}

TEST(Follow, RefusesToFollowForNothingOrForEver) {
  const Plan plan = circuit_plan();
  const ExactFlights exact(plan);
  const SampledFlights sampled(plan, {});
  const State start{{20.0, 20.0}, Heading{}};
  for (const FollowLimit limit : {FollowLimit{}, FollowLimit{0.0, 5.0}, FollowLimit{5.0, -1.0}}) {
    EXPECT_THROW((void)exact.follow_on(start, limit), PreconditionViolation);
    EXPECT_THROW((void)sampled.follow_on(start, 0, limit), PreconditionViolation);
  }
}

}  // namespace
}  // namespace fairway
