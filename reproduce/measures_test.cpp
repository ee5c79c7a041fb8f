#include "reproduce/measures.hpp"

#include <gtest/gtest.h>

#include "fairway/base/heading.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway::reproduce {
namespace {

/// Pieces (length, curvature) flown one after the other from the origin, heading east, at 10 m/s.
Flight flight_of(const std::vector<std::pair<double, double>>& pieces, State here = {}) {
  Flight flight{here, {Outcome::reach, 0.0, 0.0}, {}};
  double time_s = 0.0;
  for (const auto& [length_m, k] : pieces) {
    flight.segments.push_back({here, time_s, length_m, k});
    const double h = here.heading.rad();
    const Vec2 moved = k == 0.0 ? length_m * here.heading.unit()
                                : 1.0 / k *
                                      Vec2{std::sin(h + k * length_m) - std::sin(h),
                                           std::cos(h) - std::cos(h + k * length_m)};
    here = {here.position_m + moved, Heading::from_rad(h + k * length_m)};
    time_s += length_m / 10.0;
  }
  return flight;
}

TEST(HeadingMeasures, AStraightFlightDoesNotTurn) {
  const auto m = heading_measures(flight_of({{500.0, 0.0}}), 10.0, 4.0);
  EXPECT_EQ(m.turning_rad, 0.0);
  EXPECT_EQ(m.reversals, 0);
  EXPECT_EQ(m.rms_rate_radps, 0.0);
}

TEST(HeadingMeasures, TheFirstTurnDoesNotCount) {
  const auto m = heading_measures(flight_of({{40.0, 0.05}, {500.0, 0.0}}), 10.0, 4.0);
  EXPECT_EQ(m.turning_rad, 0.0);
  EXPECT_EQ(m.largest_rate_radps, 0.0);
}

TEST(HeadingMeasures, ASteadyTurnHasItsRateAndNoReversal) {
  const auto m = heading_measures(flight_of({{1.0, 0.0}, {400.0, -0.05}}), 10.0, 4.0);
  EXPECT_NEAR(m.turning_rad, 20.0, 1e-9);
  EXPECT_EQ(m.reversals, 0);
  EXPECT_NEAR(m.largest_rate_radps, 0.5, 1e-9);
  EXPECT_NEAR(m.rms_rate_radps, 0.5, 0.01);
}

TEST(HeadingMeasures, WeavingReversesButDoesNotShowInTheMeanRate) {
  std::vector<std::pair<double, double>> pieces;
  for (int i = 0; i < 51; ++i)  // the first turn does not count
    pieces.push_back({10.0, i % 2 == 0 ? 0.05 : -0.05});
  const auto m = heading_measures(flight_of(pieces), 10.0, 2.0);  // one weave per window
  EXPECT_EQ(m.reversals, 49);
  EXPECT_NEAR(m.turning_rad, 25.0, 1e-9);
  EXPECT_NEAR(m.largest_rate_radps, 0.0, 1e-9);
}

TEST(PathMeasures, AFlightAlongsideAStraightPathKeepsItsDistance) {
  const PathMission path{{{-100.0, 3.0}, {600.0, 3.0}}, false};
  const auto m = path_measures(flight_of({{500.0, 0.0}}), 10.0, path, 50.0, 1.0);
  EXPECT_NEAR(m.mean_m, 3.0, 1e-9);
  EXPECT_NEAR(m.max_m, 3.0, 1e-9);
  EXPECT_NEAR(m.mean_of_straights_m, 3.0, 1e-9);
  EXPECT_TRUE(m.corner_m.empty());
}

TEST(PathMeasures, ACornerCutByAQuarterCircleHasTheSpikeThatGeometryGives) {
  // Path: east, then north at (200, 0). Flight: leaves it 20 m before, on a circle of 20 m.
  const PathMission path{{{0.0, 0.0}, {200.0, 0.0}, {200.0, 300.0}}, false};
  const auto m = path_measures(flight_of({{180.0, 0.0}, {10.0 * pi, 0.05}, {200.0, 0.0}}), 10.0,
                               path, 60.0, 0.01);
  ASSERT_EQ(m.corner_m.size(), 1U);
  EXPECT_NEAR(m.corner_m[0], 20.0 * (1.0 - std::sqrt(0.5)), 4e-3);  // half a step's rise
  EXPECT_NEAR(m.max_m, m.corner_m[0], 1e-12);
  EXPECT_NEAR(m.mean_of_straights_m, 0.0, 1e-9);
}

TEST(PathMeasures, TheLengthOfAClosedPathIncludesItsClosingEdge) {
  EXPECT_DOUBLE_EQ(length_of({{{0.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}}, false}), 7.0);
  EXPECT_DOUBLE_EQ(length_of({{{0.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}}, true}), 12.0);
}

}  // namespace
}  // namespace fairway::reproduce
