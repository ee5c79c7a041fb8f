#include "fairway/simulate/sampled_flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway {
namespace {

Plan plan_of(const std::function<float(Vec2)>& heading) {
  Plan plan;
  plan.grid = {64, 64, 0.0, 0.0, 2.0};
  plan.vehicle = {10.0, 5.0};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    plan.heading_rad.push_back(heading(plan.grid.center(plan.grid.cell_at(i))));
  }
  return plan;
}

Plan uniform_plan() {
  return plan_of([](Vec2) { return 0.0F; });
}

State state(double x, double y, double heading_rad) {
  return {{x, y}, Heading::from_rad(heading_rad)};
}

TEST(SampledFlight, TendsToTheExactFlightAsTheControlPeriodShrinks) {
  Plan plan = plan_of([](Vec2 p) {
    const double to_goal = std::atan2(64.0 - p.y, 64.0 - p.x);
    return Heading::stored(to_goal + 0.5 * std::sin(p.x / 11.0));
  });
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    if (norm(plan.grid.center(plan.grid.cell_at(i)) - Vec2{64.0, 64.0}) < 12.0) {
      plan.region[i] = Region::goal;
    }
  }
  const ExactFlights exact(plan);
  std::vector<State> starts;
  Random random(31);
  for (int i = 0; i < 40; ++i) {
    const double x = random.uniform(5.0, 40.0);
    const double y = random.uniform(5.0, 120.0);
    starts.push_back(state(x, y, random.uniform(-1.5, 1.5)));  // roughly towards the goal
  }
  std::vector<double> errors_m;
  for (const double period_s : {0.04, 0.01, 0.0025}) {
    SampledOptions options;
    options.control_period_s = period_s;
    const SampledFlights sampled(plan, options);
    double sum_m = 0.0;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const FlightResult a = exact.fly(starts[i]);
      const FlightResult b = sampled.fly(starts[i], i);
      ASSERT_EQ(a.outcome, Outcome::reach);
      ASSERT_EQ(b.outcome, Outcome::reach);
      sum_m += std::abs(a.length_m - b.length_m);
    }
    errors_m.push_back(sum_m / static_cast<double>(starts.size()));
  }
  // First order in the period: a quarter of the period, about a quarter of the error.
  EXPECT_LT(errors_m[1], 0.5 * errors_m[0]);
  EXPECT_LT(errors_m[2], 0.5 * errors_m[1]);
  EXPECT_LT(errors_m[2], 0.05);
}

TEST(SampledFlight, DriftsWithTheWind) {
  const Plan plan = plan_of([](Vec2) { return std::nanf(""); });
  SampledOptions options;
  options.wind_mps = {-2.0, 3.0};
  const SampledFlight flight = SampledFlights(plan, options).record(state(10.0, 10.0, 0.0), 0);
  EXPECT_EQ(flight.flight.result.outcome, Outcome::leave);
  // East at 10 - 2, north at 3: out at x = 128 after 118 / 8 s.
  EXPECT_NEAR(flight.flight.result.time_s, 118.0 / 8.0, 1e-9);
  EXPECT_NEAR(flight.flight.result.length_m, 118.0 / 8.0 * std::hypot(8.0, 3.0), 1e-9);
  EXPECT_NEAR(flight.samples.back().state.position_m.y, 10.0 + 3.0 * flight.samples.back().time_s,
              1e-9);
}

TEST(SampledFlight, FliesATrochoidWhenItTurnsInTheWind) {
  const Plan plan = uniform_plan();
  SampledOptions options;
  options.law = CustomLaw([](const Measurement&) { return 1.0; });  // rad/s, circle of 10 m in air
  options.wind_mps = {1.0, 0.5};
  options.control_period_s = 0.1;
  const SampledFlight flight = SampledFlights(plan, options).record(state(60.0, 60.0, 0.0), 0);
  ASSERT_GT(flight.samples.size(), 80U);
  for (const FlightSample& sample : flight.samples) {
    const double t = sample.time_s;
    if (t > 8.0) break;
    EXPECT_NEAR(sample.state.position_m.x, 60.0 + 10.0 * std::sin(t) + 1.0 * t, 1e-9);
    EXPECT_NEAR(sample.state.position_m.y, 60.0 + 10.0 * (1.0 - std::cos(t)) + 0.5 * t, 1e-9);
  }
}

TEST(SampledFlight, TurnsAtItsLimitInTheBufferWhateverTheLaw) {
  Plan plan = uniform_plan();
  SampledOptions options;
  options.law = CustomLaw([](const Measurement&) { return 0.0; });
  const State start = state(60.0, 60.0, pi / 2);
  const SampledFlight free = SampledFlights(plan, options).record(start, 0);
  for (const FlightSample& sample : free.samples) EXPECT_EQ(sample.turn_rate_radps, 0.0);
  plan.region.assign(plan.grid.size(), Region::buffer);
  const SampledFlight buffer = SampledFlights(plan, options).record(start, 0);
  EXPECT_EQ(buffer.samples.front().turn_rate_radps, -2.0);  // v / r to the right
}

TEST(SampledFlight, NeverTurnsFasterThanTheVehicleCan) {
  const Plan plan = uniform_plan();
  SampledOptions options;
  options.law = SaturatedProportional{0.5};
  const SampledFlight gentle = SampledFlights(plan, options).record(state(60.0, 60.0, -1.0), 0);
  EXPECT_DOUBLE_EQ(gentle.samples.front().turn_rate_radps, 0.5);
  options.law = SaturatedProportional{50.0};
  options.heading_noise_rad = 0.5;
  const SampledFlight hard = SampledFlights(plan, options).record(state(60.0, 60.0, -1.0), 0);
  for (const FlightSample& sample : hard.samples) {
    EXPECT_LE(std::abs(sample.turn_rate_radps), 2.0);
  }
}

TEST(SampledFlight, BlowsGustsOfTheStrengthAndMemoryAsked) {
  const Plan plan = plan_of([](Vec2) { return std::nanf(""); });
  SampledOptions options;
  options.gust_mps = 1.5;
  options.gust_time_s = 2.0;
  options.control_period_s = 0.1;
  double square = 0.0;
  double lagged = 0.0;
  double count = 0.0;
  const SampledFlights flights(plan, options);
  for (std::size_t i = 0; i < 2000; ++i) {
    const SampledFlight flight = flights.record(state(20.0, 64.0, 0.0), i);
    const auto& s = flight.samples;
    for (std::size_t k = 0; k + 20 < s.size() && k < 60; k += 20) {  // 20 periods: one memory time
      square += s[k].wind_mps.x * s[k].wind_mps.x;
      lagged += s[k].wind_mps.x * s[k + 20].wind_mps.x;
      count += 1.0;
    }
  }
  EXPECT_NEAR(square / count, 1.5 * 1.5, 0.2);
  EXPECT_NEAR(lagged / square, std::exp(-1.0), 0.06);
}

TEST(SampledFlight, DependsOnSeedAndIndexAlone) {
  const Plan plan = uniform_plan();
  SampledOptions options;
  options.position_noise_m = 1.0;
  options.heading_noise_rad = 0.1;
  options.gust_mps = 2.0;
  std::vector<State> starts(50, state(40.0, 64.0, 2.0));
  const SampledFlights flights(plan, options);
  const auto together = flights.fly_all(starts);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_EQ(together[i].length_m, flights.fly(starts[i], i).length_m);
    EXPECT_EQ(together[i].length_m, flights.record(starts[i], i).flight.result.length_m);
  }
  EXPECT_NE(together[0].length_m, together[1].length_m);
  options.seed = 2;
  EXPECT_NE(together[0].length_m, SampledFlights(plan, options).fly(starts[0], 0).length_m);
}

TEST(SampledFlight, SeesASingleObstacleCellInItsWay) {
  Plan plan = plan_of([](Vec2) { return std::nanf(""); });
  plan.region[plan.grid.index({40, 32})] = Region::obstacle;
  SampledOptions options;
  options.control_period_s = 1.0;  // ten metres between control instants
  const FlightResult hit = SampledFlights(plan, options).fly(state(10.0, 64.3, 0.0), 0);
  EXPECT_EQ(hit.outcome, Outcome::collide);
  EXPECT_NEAR(hit.length_m, 70.0, 1e-9);
  EXPECT_EQ(SampledFlights(plan, options).fly(state(10.0, 66.3, 0.0), 0).outcome, Outcome::leave);
}

TEST(SampledFlight, RefusesOptionsOutOfRange) {
  const Plan plan = uniform_plan();
  SampledOptions options;
  options.control_period_s = 0.0;
  EXPECT_THROW(SampledFlights(plan, options), PreconditionViolation);
  options = {};
  options.law = SaturatedProportional{-1.0};
  EXPECT_THROW(SampledFlights(plan, options), PreconditionViolation);
  options = {};
  options.law = CustomLaw{};
  EXPECT_THROW(SampledFlights(plan, options), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
