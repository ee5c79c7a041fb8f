#include "fairway/exchange/track.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

constexpr double speed_mps = 4.0;

/// Arcs and straight lines drawn at random, joined end to end.
Flight wandering(Random& random, int pieces) {
  Flight flight;
  flight.start = {{random.uniform(-1e3, 1e3), random.uniform(-1e3, 1e3)},
                  Heading::from_rad(random.uniform(-pi, pi))};
  State at = flight.start;
  double time_s = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double curvature = i % 3 == 0 ? 0.0 : random.uniform(-0.2, 0.2);
    const double length_m = i % 5 == 4 ? 1e-9 : random.uniform(0.1, 40.0);
    flight.segments.push_back({at, time_s, length_m, curvature});
    at = state_at(flight.segments.back(), length_m);
    time_s += length_m / speed_mps;
  }
  flight.result = {Outcome::reach, time_s, time_s * speed_mps};
  return flight;
}

double distance_m(Vec2 p, const std::vector<FlightPoint>& line) {
  double least_m = norm(p - line.front().state.position_m);
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 a = line[i - 1].state.position_m;
    const Vec2 along = line[i].state.position_m - a;
    const double length2 = norm2(along);
    const double share = length2 > 0.0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
    least_m = std::min(least_m, norm(p - (a + share * along)));
  }
  return least_m;
}

TEST(Track, KeepsPointsNoFartherApartThanAskedFromStartToEnd) {
  Random random(7);
  for (int draw = 0; draw < 50; ++draw) {
    const Flight flight = wandering(random, 1 + draw % 9);
    const double step_m = random.uniform(0.2, 30.0);
    const auto track = track_of(flight, speed_mps, step_m);
    EXPECT_EQ(track.front().state, flight.start);
    EXPECT_NEAR(track.back().time_s, flight.result.time_s, 1e-9);
    const FlightSegment& last = flight.segments.back();
    EXPECT_EQ(track.back().state, state_at(last, last.length_m));
    for (std::size_t i = 1; i < track.size(); ++i) {
      EXPECT_LE((track[i].time_s - track[i - 1].time_s) * speed_mps, step_m + 1e-9);
      EXPECT_GT(track[i].time_s, track[i - 1].time_s);
    }
  }
}

TEST(Track, ThinnedStaysWithinTheToleranceOfEveryPointOfTheFlight) {
  Random random(11);
  for (int draw = 0; draw < 60; ++draw) {
    const Flight flight = wandering(random, 1 + draw % 12);
    const double tolerance_m = std::pow(10.0, random.uniform(-3.0, 1.5));
    const auto thin = thinned_track(flight, speed_mps, tolerance_m);
    EXPECT_EQ(thin.front().state, flight.start);
    const auto fine = track_of(flight, speed_mps, 0.05);
    EXPECT_EQ(thin.back().state, fine.back().state);
    for (const FlightPoint& point : fine) {
      ASSERT_LE(distance_m(point.state.position_m, thin), tolerance_m) << "draw " << draw;
    }
    EXPECT_LE(thin.size(), thinned_track(flight, speed_mps, tolerance_m / 8.0).size());
  }
}

TEST(Track, AWholeCircleIsMoreThanItsEndPoints) {
  Flight flight;
  flight.segments = {{flight.start, 0.0, two_pi * 10.0, 0.1}};
  EXPECT_GE(thinned_track(flight, speed_mps, 1.0).size(), 6U);
  EXPECT_GE(thinned_track(flight, speed_mps, 1000.0).size(), 2U);
}

TEST(Track, StraightLinesNeedTheirEndsAlone) {
  Flight flight;
  State at = flight.start;
  for (int i = 0; i < 20; ++i) {
    flight.segments.push_back({at, i * 1.0, 4.0, 0.0});
    at = state_at(flight.segments.back(), 4.0);
  }
  EXPECT_EQ(thinned_track(flight, speed_mps, 0.01).size(), 2U);
}

TEST(Track, GoesOnAlongTheLastLeg) {
  Random random(13);
  const Flight all = wandering(random, 9);
  Flight flight = all;
  flight.final_leg.segments.assign(all.segments.begin() + 6, all.segments.end());
  flight.segments.resize(6);
  EXPECT_EQ(track_of(flight, speed_mps, 2.0).size(), track_of(all, speed_mps, 2.0).size());
  EXPECT_EQ(thinned_track(flight, speed_mps, 0.5).back().state,
            thinned_track(all, speed_mps, 0.5).back().state);
}

TEST(Track, OfAFlightWithoutPiecesIsItsStart) {
  Flight flight;
  flight.start = {{3.0, 4.0}, Heading::from_rad(1.0)};
  ASSERT_EQ(track_of(flight, speed_mps, 1.0).size(), 1U);
  EXPECT_EQ(thinned_track(flight, speed_mps, 1.0).front().state, flight.start);
  EXPECT_THROW((void)track_of(flight, speed_mps, 0.0), PreconditionViolation);
  EXPECT_THROW((void)thinned_track(flight, speed_mps, 0.0), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
