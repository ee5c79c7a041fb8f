#include "fairway/simulate/path_measures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/sampled_flight.hpp"
#include "fairway/simulate/testing/circuit_plan.hpp"

namespace fairway {
namespace {

using testing::circuit_path;
using testing::circuit_plan;

/// A flight of one straight piece.
Flight straight(Vec2 from, double heading_rad, double length_m) {
  Flight flight;
  flight.start = {from, Heading::from_rad(heading_rad)};
  flight.result = {Outcome::reach, 0.0, 0.0};
  flight.segments = {{flight.start, 0.0, length_m, 0.0}};
  flight.onward = {After::follow, length_m / 10.0, length_m};
  return flight;
}

TEST(PathMeter, MeasuresAFlightBesideAStraightPath) {
  const PathMission path{{{0.0, 0.0}, {100.0, 0.0}}, false, 4.0, 0.5};
  const PathMeter meter(path, 10.0, 0.5);
  const PathFollowing beside = meter.measure(straight({10.0, 3.0}, 0.0, 60.0));
  EXPECT_EQ(beside.joined_s, 0.0);
  EXPECT_EQ(beside.on_path_share, 1.0);
  EXPECT_NEAR(beside.distance_mean_m, 3.0, 1e-12);
  EXPECT_NEAR(beside.distance_worst_m, 3.0, 1e-12);
  EXPECT_EQ(beside.heading_worst_rad, 0.0);
  EXPECT_NEAR(beside.laps, 0.6, 0.01);
  EXPECT_NEAR(beside.measured_s, 6.0, 0.06);
  // Out of the deltas at y = 4, after 1 / sin(0.3) m, and still measured.
  const PathFollowing away = meter.measure(straight({10.0, 3.0}, 0.3, 40.0));
  EXPECT_NEAR(away.on_path_share, 1.0 / std::sin(0.3) / 40.0, 0.02);
  EXPECT_NEAR(away.distance_worst_m, 3.0 + 40.0 * std::sin(0.3), 0.2);
  EXPECT_NEAR(away.heading_mean_rad, 0.3, 1e-9);
  // Across, against, and far from it: never on it.
  for (const Flight& flight : {straight({50.0, -20.0}, pi / 2, 40.0),
                               straight({90.0, 1.0}, pi, 60.0), straight({0.0, 9.0}, 0.0, 90.0)}) {
    EXPECT_EQ(meter.measure(flight), PathFollowing{});
  }
  // Beyond the end of an open path nothing is measured.
  const PathFollowing beyond = meter.measure(straight({80.0, 1.0}, 0.0, 70.0));
  EXPECT_NEAR(beyond.measured_s, 2.0, 0.06);
  EXPECT_NEAR(beyond.distance_worst_m, 1.0, 1e-12);
}

TEST(PathMeter, CountsLapsBothWaysRound) {
  for (const double way : {1.0, -1.0}) {
    const Plan plan = circuit_plan(way);
    const PathMeter meter(circuit_path(way), 10.0, 0.5);
    const double lap_m = meter.locator().length_m();
    const State start{{104.0, 64.0}, Heading::from_rad(way * pi / 2)};
    for (const double laps : {0.5, 1.0, 2.5}) {
      const Flight flight = ExactFlights(plan).follow_on(start, {.length_m = laps * lap_m});
      EXPECT_NEAR(meter.measure(flight).laps, laps, 0.06 * laps + 0.01);
      // Flown against the path's direction it joins only where the delta allows any heading.
      PathMission backwards = circuit_path(-way);
      backwards.delta_heading_rad = 3.2;
      EXPECT_NEAR(PathMeter(backwards, 10.0, 0.5).measure(flight).laps, -laps, 0.06 * laps + 0.01);
    }
  }
}

TEST(PathMeter, AgreesWithDistancesFromPointsOnThePath) {
  Random random(91);
  const Plan plan = circuit_plan();
  const PathMission path = circuit_path(1.0);
  const PathMeter meter(path, 10.0, 0.25);
  std::vector<Vec2> points;  // of the path, every 2 cm
  for_pieces(path, [&](const PathPiece& piece) {
    for (double at_m = 0.0; at_m < piece.length_m; at_m += 0.02) points.push_back(piece.at(at_m));
  });
  const ExactFlights exact(plan);
  SampledOptions options;
  options.wind_mps = {2.0, 1.0};
  const SampledFlights windy(plan, options);
  for (int k = 0; k < 12; ++k) {
    const State start{{random.uniform(10.0, 118.0), random.uniform(10.0, 118.0)},
                      Heading::from_rad(random.uniform(-pi, pi))};
    const FollowLimit limit{.length_m = 120.0};
    const Flight flight =
        k % 2 == 0 ? exact.follow_on(start, limit) : windy.follow_on(start, 0, limit).flight;
    const PathFollowing found = meter.measure(flight);
    ASSERT_TRUE(std::isfinite(found.joined_s));
    double worst_m = 0.0;
    double sum = 0.0;
    double time_s = 0.0;
    for (std::size_t i = 0; i < flight.segments.size(); ++i) {
      const FlightSegment& piece = flight.segments[i];
      const double end_s =
          i + 1 < flight.segments.size() ? flight.segments[i + 1].time_s : flight.onward.time_s;
      for (int part = 0; part < 8; ++part) {
        const double share = (part + 0.5) / 8.0;
        const double at_s = piece.time_s + share * (end_s - piece.time_s);
        if (at_s < found.joined_s) continue;
        const Vec2 p = state_at(piece, share * piece.length_m).position_m;
        double nearest_m = 1e9;
        for (const Vec2 q : points) nearest_m = std::min(nearest_m, norm(p - q));
        worst_m = std::max(worst_m, nearest_m);
        sum += nearest_m * (end_s - piece.time_s) / 8.0;
        time_s += (end_s - piece.time_s) / 8.0;
      }
    }
    EXPECT_NEAR(found.distance_worst_m, worst_m, 0.2);
    EXPECT_NEAR(found.distance_mean_m, sum / time_s, 0.05);
    EXPECT_NEAR(found.measured_s, time_s, 0.1);
  }
}

TEST(PathMeter, AnswersToBothDeltas) {
  const Plan plan = circuit_plan();
  const Flight flight =
      ExactFlights(plan).follow_on({{20.0, 20.0}, Heading{}}, {.length_m = 150.0});
  const auto measured = [&](double delta_m, double delta_rad) {
    PathMission path = circuit_path(1.0);
    path.delta_position_m = delta_m;
    path.delta_heading_rad = delta_rad;
    return PathMeter(path, 10.0, 0.5).measure(flight);
  };
  const PathFollowing wide = measured(6.0, 1.5);
  EXPECT_LT(wide.joined_s, measured(2.0, 1.5).joined_s);
  EXPECT_LE(wide.joined_s, measured(6.0, 0.1).joined_s);
  EXPECT_GT(wide.on_path_share, measured(6.0, 0.05).on_path_share);
  EXPECT_FALSE(std::isfinite(measured(6.0, 1e-9).joined_s));
}

TEST(PathMeter, AddsItsStepsToSpreads) {
  const Plan plan = circuit_plan();
  const PathMeter meter(circuit_path(1.0), 10.0, 0.5);
  const Flight flight =
      ExactFlights(plan).follow_on({{20.0, 20.0}, Heading{}}, {.length_m = 150.0});
  PathSpreads spreads;
  const PathFollowing found = meter.measure(flight, &spreads);
  EXPECT_NEAR(spreads.distance_m.spread().mean, found.distance_mean_m, 1e-9);
  EXPECT_EQ(spreads.distance_m.spread().worst, found.distance_worst_m);
  EXPECT_NEAR(spreads.heading_rad.spread().mean, found.heading_mean_rad, 1e-9);
  EXPECT_LE(spreads.heading_rad.spread().p95, found.heading_worst_rad);
  EXPECT_THROW(PathMeter(circuit_path(1.0), 0.0, 1.0), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
