#include "fairway/run/flight_costs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fairway/run/stratified_states.hpp"
#include "fairway/simulate/testing/circuit_plan.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

constexpr double radius_m = 5.0;
constexpr double goal_x_m = 196.0;
constexpr double wall_y_m = 98.0;

/// 100 x 50 cells of 2 m that all say east; goal cells at the right end, a wall along the top.
Plan eastward_plan() {
  Plan plan = empty_plan(100, 50, 2.0, radius_m);
  for (int iy = 0; iy < 50; ++iy) {
    plan.region[plan.grid.index({98, iy})] = Region::goal;
    plan.region[plan.grid.index({99, iy})] = Region::goal;
  }
  for (int ix = 0; ix < 100; ++ix) plan.region[plan.grid.index({ix, 49})] = Region::obstacle;
  return plan;
}

TEST(FlightCosts, AreThoseWorkedByHandOnAnEmptyMap) {
  const Plan plan = eastward_plan();
  // With heading h the vehicle turns by |h| on an arc, moves r sin |h| east and r (1 - cos h) to
  // the side on which it points, and goes straight on.
  const std::vector<State> states{{{100.0, 50.0}, Heading::from_rad(0.0)},
                                  {{100.0, 50.0}, Heading::from_rad(pi / 2)},
                                  {{60.0, 70.0}, Heading::from_rad(-2.0)},
                                  {{20.0, 90.0}, Heading::from_rad(1.0)}};
  const MeasuredFlights flown = measure_flights(plan, states, {}, line_around_obstacles(plan));
  double lengths = 0.0;
  double turns = 0.0;
  double bounds = 0.0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double h = states[i].heading.rad();
    const Vec2 p = states[i].position_m;
    const double length_m =
        radius_m * std::abs(h) + goal_x_m - p.x - radius_m * std::sin(std::abs(h));
    const double top_m = p.y + (h > 0.0 ? radius_m * (1.0 - std::cos(h)) : 0.0);
    const MeasuredFlight& f = flown.flights[i];
    EXPECT_TRUE(f.succeeds);
    EXPECT_NEAR(f.result.length_m, length_m, 1e-9);
    EXPECT_NEAR(f.measures.turning.turned_rad, std::abs(h), 1e-9);
    EXPECT_EQ(f.measures.turning.reversals, 0U);
    EXPECT_GE(f.clearance_m, wall_y_m - top_m - 1e-9);
    EXPECT_LE(f.clearance_m, wall_y_m - top_m + 2.0 / 16.0);
    EXPECT_NEAR(f.shortest_bound_m, goal_x_m - p.x, 1e-9);
    lengths += length_m;
    turns += std::abs(h);
    bounds += goal_x_m - p.x;
  }
  const FlightCosts costs = flight_costs(flown);
  EXPECT_EQ(costs.states, 4U);
  EXPECT_EQ(costs.succeeds.value, 1.0);
  EXPECT_EQ(costs.outcome[static_cast<std::size_t>(Outcome::reach)].value, 1.0);
  EXPECT_NEAR(costs.length_m.value, lengths / 4.0, 1e-9);
  EXPECT_NEAR(costs.time_s.value, lengths / 4.0 / 10.0, 1e-9);
  EXPECT_NEAR(costs.length_ratio.value, lengths / bounds, 1e-12);
  EXPECT_NEAR(costs.turned_rad_per_100m.value, 100.0 * turns / lengths, 1e-9);
  EXPECT_EQ(costs.reversals_per_100m.value, 0.0);
  EXPECT_FALSE(costs.path);
}

TEST(FlightCosts, OverAllStatesHoldTheTruthOfManyMoreWithinTheirErrors) {
  const Plan plan = eastward_plan();
  std::vector<bool> ground(plan.grid.size());
  for (std::size_t i = 0; i < ground.size(); ++i) ground[i] = plan.region[i] == Region::free;
  const LengthBound bound = line_around_obstacles(plan);
  const auto costs_of = [&](std::size_t strata, std::uint64_t seed) {
    return flight_costs(
        measure_flights(plan, stratified_states(plan.grid, ground, strata, seed), {}, bound));
  };
  const FlightCosts truth = costs_of(15'000, 99);
  int held = 0;
  constexpr int draws = 40;
  const auto holds = [](const SampledValue& e, const SampledValue& of) {
    return std::abs(e.value - of.value) <= 1.96 * std::hypot(e.standard_error, of.standard_error);
  };
  for (std::uint64_t seed = 0; seed < draws; ++seed) {
    const FlightCosts costs = costs_of(200, seed);
    held += holds(costs.succeeds, truth.succeeds) ? 1 : 0;
    held += holds(costs.time_s, truth.time_s) ? 1 : 0;
    held += holds(costs.length_ratio, truth.length_ratio) ? 1 : 0;
    held += holds(costs.turned_rad_per_100m, truth.turned_rad_per_100m) ? 1 : 0;
    EXPECT_GE(truth.clearance_median_m.value, costs.clearance_median_m.low - 0.5);
    EXPECT_LE(truth.clearance_median_m.value, costs.clearance_median_m.high + 0.5);
  }
  EXPECT_GE(held, 138);  // 95 % of 160 is 152
}

TEST(FlightCosts, OfALoopCountOnlyFlightsThatGoOnAlongIt) {
  const std::vector<State> states{{{64.0, 64.0}, Heading::from_rad(0.3)},
                                  {{100.0, 70.0}, Heading::from_rad(1.5)},
                                  {{30.0, 30.0}, Heading::from_rad(-1.0)},
                                  {{64.0, 110.0}, Heading::from_rad(3.0)}};
  const Plan plan = testing::circuit_plan();
  const FlightCosts costs =
      flight_costs(measure_flights(plan, states, {}, line_around_obstacles(plan)));
  EXPECT_EQ(costs.succeeds.value, 1.0);
  ASSERT_TRUE(costs.path);
  EXPECT_EQ(costs.path->joined.value, 1.0);
  EXPECT_GT(costs.path->time_to_join_s.value, 0.5);
  EXPECT_LT(costs.path->time_to_join_s.value, 8.0);
  EXPECT_GT(costs.path->distance_m.value, 0.0);
  EXPECT_LT(costs.path->distance_m.value, costs.path->distance_p95_m);
  EXPECT_LE(costs.path->distance_p95_m, costs.path->distance_worst_m * (1.0 + 1.0 / 64.0));
  EXPECT_LT(costs.path->distance_worst_m, 5.0);  // a turning radius
  const Plan walled = testing::walled_circuit_plan();
  const FlightCosts failing =
      flight_costs(measure_flights(walled, states, {}, line_around_obstacles(walled)));
  EXPECT_EQ(failing.succeeds.value, 0.0);  // each touches the path, and then the wall across it
  EXPECT_EQ(failing.outcome[static_cast<std::size_t>(Outcome::reach)].value, 1.0);
}

TEST(FlightCosts, LeaveOutStatesThatWereNotChosen) {
  const Plan plan = eastward_plan();
  const std::vector<State> states{{{100.0, 50.0}, Heading::from_rad(0.0)},
                                  {{100.0, 99.0}, Heading::from_rad(0.0)}};
  const MeasuredFlights flown =
      measure_flights(plan, states, {true, false}, line_around_obstacles(plan));
  EXPECT_EQ(flight_costs(flown).states, 1U);
  EXPECT_EQ(flight_costs(flown).succeeds.value, 1.0);
  EXPECT_NEAR(flight_costs(flown).length_m.value, 96.0, 1e-9);
}

}  // namespace
}  // namespace fairway
