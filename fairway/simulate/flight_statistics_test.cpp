#include "fairway/simulate/flight_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

State state(double x, double y, double heading_rad) {
  return {{x, y}, Heading::from_rad(heading_rad)};
}

TEST(FlightStatistics, CountsHowManyFlightsEndedHow) {
  const std::vector<FlightResult> results{{Outcome::reach, 1.0, 1.0},
                                          {Outcome::trapped, 1.0, 1.0},
                                          {Outcome::reach, 1.0, 1.0},
                                          {Outcome::collide, 0.0, 0.0}};
  const OutcomeCounts counts = count_outcomes(results);
  EXPECT_EQ(counts.total(), 4U);
  EXPECT_EQ(counts.of(Outcome::collide), 1U);
  EXPECT_EQ(counts.of(Outcome::leave), 0U);
  EXPECT_EQ(counts.share(Outcome::reach), 0.5);
  EXPECT_EQ(count_outcomes({}).share(Outcome::reach), 0.0);
}

TEST(FlightStatistics, FindsTheNearestPointOfAPath) {
  const PathMission open{{{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}}, false};
  const PathPoint beside = nearest_on_path({4.0, 3.0}, open);
  EXPECT_EQ(beside.position_m, (Vec2{4.0, 0.0}));
  EXPECT_EQ(beside.distance_m, 3.0);
  EXPECT_EQ(beside.along_m, 4.0);
  EXPECT_EQ(beside.tangent.rad(), 0.0);
  const PathPoint beyond = nearest_on_path({10.0, 14.0}, open);
  EXPECT_EQ(beyond.distance_m, 4.0);
  EXPECT_EQ(beyond.along_m, 20.0);
  EXPECT_EQ(beyond.tangent.rad(), pi / 2);
  PathMission closed = open;
  closed.closed = true;
  EXPECT_NEAR(nearest_on_path({4.0, 6.0}, closed).distance_m, std::sqrt(2.0), 1e-15);
}

TEST(FlightStatistics, KnowsTheGoalSetOfAPath) {
  const PathMission path{{{0.0, 0.0}, {100.0, 0.0}}, false, 10.0, 0.5};
  EXPECT_TRUE(on_path(state(50.0, 9.99, 0.49), path));
  EXPECT_FALSE(on_path(state(50.0, 10.0, 0.0), path));  // strictly
  EXPECT_FALSE(on_path(state(50.0, 0.0, 0.5), path));
  EXPECT_FALSE(on_path(state(50.0, 0.0, pi), path));
  EXPECT_TRUE(on_path(state(-9.99, 9.99, 0.0), path));  // a box, not a disc
  EXPECT_FALSE(on_path(state(-10.0, 0.0, 0.0), path));
}

TEST(FlightStatistics, AgreesWithPointsSampledOnThePath) {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    PathMission path;
    path.closed = random.below(2) == 0;
    path.delta_position_m = random.uniform(0.5, 4.0);
    path.delta_heading_rad = random.uniform(0.2, 2.0);
    for (int k = 0; k < 5; ++k) {
      path.vertices_m.push_back({random.uniform(0.0, 20.0), random.uniform(0.0, 20.0)});
    }
    const State s =
        state(random.uniform(0.0, 20.0), random.uniform(0.0, 20.0), random.uniform(-pi, pi));
    bool inside = false;
    bool near_limit = false;
    double nearest_m = 1e9;
    const std::size_t edges = path.closed ? 5 : 4;
    for (std::size_t e = 0; e < edges; ++e) {
      const Vec2 a = path.vertices_m[e];
      const Vec2 b = path.vertices_m[(e + 1) % 5];
      const double turn = std::abs(s.heading.turn_to(Heading::of(b - a)));
      for (int k = 0; k <= 4000; ++k) {
        const Vec2 off = a + (k / 4000.0) * (b - a) - s.position_m;
        nearest_m = std::min(nearest_m, norm(off));
        const double box = std::max(std::abs(off.x), std::abs(off.y));
        if (turn >= path.delta_heading_rad) continue;
        inside = inside || box < path.delta_position_m;
        near_limit = near_limit || std::abs(box - path.delta_position_m) < 0.01;
      }
    }
    EXPECT_NEAR(nearest_on_path(s.position_m, path).distance_m, nearest_m, 1e-3);
    if (inside || !near_limit) {
      EXPECT_EQ(on_path(s, path), inside) << i;
    }
  }
}

TEST(FlightStatistics, SamplesAFlightBesideItsPath) {
  Flight flight;
  flight.start = state(0.0, 3.0, 0.0);
  flight.segments = {{flight.start, 0.0, 30.0, 0.0}, {state(30.0, 3.0, 0.0), 3.0, 10.0, 0.0}};
  const PathMission path{{{0.0, 0.0}, {100.0, 0.0}}, false, 10.0, 0.5};
  const auto samples = sample_along_path(flight, path, 10.0, 4.0);
  double last_m = 0.0;
  for (const PathSample& sample : samples) {
    EXPECT_LE(sample.length_m - last_m, 4.0);
    last_m = sample.length_m;
    EXPECT_NEAR(sample.nearest.distance_m, 3.0, 1e-12);
    EXPECT_NEAR(sample.state.position_m.x, sample.length_m, 1e-12);
    EXPECT_NEAR(sample.time_s, sample.length_m / 10.0, 1e-12);
    EXPECT_TRUE(sample.on_path);
  }
  EXPECT_EQ(last_m, 40.0);
}

}  // namespace
}  // namespace fairway
