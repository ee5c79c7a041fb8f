// Flights of plans with modes: decided by a proof, or by trials where there is only the plan.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include <tbb/global_control.h>

#include "fairway/base/random.hpp"
#include "fairway/run/flight_costs.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/run/fly_many.hpp"
#include "fairway/run/proved_modes.hpp"
#include "fairway/simulate/start_states.hpp"
#include "fairway/verify/ask_modes.hpp"
#include "fairway/verify/certify.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/testing/street_plan.hpp"

namespace fairway {
namespace {

/// A plan with what is proved of it.
struct ProvedPlan {
  Plan plan;
  PlanFlow held;
  Certified certified;

  explicit ProvedPlan(Plan made) : plan(std::move(made)), held(plan) {
    CertifyOptions options;
    options.samples = 2000;
    options.last_level = 12;
    certified = certify(held.flow(), held.is_free, options, {}, {}, plan.further_rad());
  }
  ProofView proof() const {
    return {held.flow(), certified.sections.view(), static_cast<int>(plan.further_modes()),
            plan.mode_heading_rad.data(), certified.further.view()};
  }
};

const ProvedPlan& street() {
  static const ProvedPlan proved(street_plan(4));
  return proved;
}

std::vector<State> starts(const Plan& plan, std::size_t count) {
  return random_states(plan, StartRegion::flyable, count, 7);
}

TEST(ModalFlights, FlyInTheModeThatIsProvedAndArriveWithinItsBound) {
  const ProvedPlan& proved = street();
  FlightEngine engine(proved.plan);
  ASSERT_TRUE(engine.has_modes());
  engine.decide_by(proved.proof());
  std::array<int, 2> reach{};
  int lost = 0;
  for (const State& start : starts(proved.plan, 3000)) {
    const ProvedState known =
        ask_all_modes(proved.proof(), start.position_m.x, start.position_m.y, start.heading.rad());
    const FlightResult flown = engine.fly(start, 0);
    EXPECT_EQ(flown.mode, known.mode);
    if (known.verdict == Verdict::undecided) continue;
    ASSERT_EQ(static_cast<int>(flown.outcome), static_cast<int>(known.verdict));
    if (known.verdict != Verdict::reach) {
      ++lost;
      continue;
    }
    ASSERT_LE(flown.time_s, known.time_s * (1.0 + 1e-9));
    ++reach[known.mode > 0 ? 1 : 0];
  }
  EXPECT_GT(reach[0], 300);
  EXPECT_GT(reach[1], 300);
  EXPECT_GT(lost, 30);
}

TEST(ModalFlights, AreFoundByTrialsWhereThereIsOnlyThePlan) {
  const ProvedPlan& proved = street();
  const Plan first_alone = street_plan(0);
  const FlightEngine engine(proved.plan);
  const FlightEngine alone(first_alone);
  EXPECT_FALSE(alone.has_modes());
  EXPECT_FALSE(FlightEngine(proved.plan, SampledOptions{}).has_modes());
  int saved = 0;
  int missed = 0;
  for (const State& start : starts(proved.plan, 600)) {
    const FlightResult flown = engine.fly(start, 0);
    const FlightResult without = alone.fly(start, 0);
    if (without.outcome == Outcome::reach || flown.outcome != Outcome::reach) {
      // As without modes, to the bit.
      ASSERT_EQ(flown.mode, 0);
      ASSERT_EQ(flown.outcome, without.outcome);
      ASSERT_EQ(flown.length_m, without.length_m);
    } else {
      ASSERT_GT(flown.mode, 0);
      ++saved;
    }
    const ProvedState known =
        ask_all_modes(proved.proof(), start.position_m.x, start.position_m.y, start.heading.rad());
    missed += known.verdict == Verdict::reach && flown.outcome != Outcome::reach ? 1 : 0;
  }
  EXPECT_GT(saved, 60);
  EXPECT_LT(missed, 6);  // trials are not all that a proof looks at
}

TEST(ModalFlights, ResultRecordAndMeasureAreOneFlight) {
  const ProvedPlan& proved = street();
  FlightEngine by_proof(proved.plan);
  by_proof.decide_by(proved.proof());
  const FlightEngine by_trials(proved.plan);
  int further = 0;
  for (const FlightEngine* engine : std::array<const FlightEngine*, 2>{&by_proof, &by_trials}) {
    for (const State& start : starts(proved.plan, 150)) {
      const FlightResult result = engine->fly(start, 0);
      const Flight record = engine->record(start, 0);
      const Flight measure = engine->measure(start, 0);
      for (const FlightResult& other : {record.result, measure.result}) {
        ASSERT_EQ(other.outcome, result.outcome);
        ASSERT_EQ(other.length_m, result.length_m);
        ASSERT_EQ(other.mode, result.mode);
      }
      ASSERT_EQ(record.turning, measure.turning);
      if (record.segments.empty()) continue;
      ASSERT_EQ(record.segments.front().mode, result.mode);
      for (std::size_t i = 1; i < record.segments.size(); ++i) {
        ASSERT_LE(record.segments[i].mode, record.segments[i - 1].mode);
      }
      further += result.mode > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(further, 40);
}

TEST(ModalFlights, DoNotDependOnTheNumberOfThreads) {
  const FlightEngine engine(street().plan);
  const std::vector<State> from = starts(street().plan, 200);
  FlyOptions options;
  options.tracks = 50;
  options.measure = true;
  const ManyFlights many = fly_many(engine, from, options);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ManyFlights alone = fly_many(engine, from, options);
  for (std::size_t i = 0; i < from.size(); ++i) {
    ASSERT_EQ(many.results[i].length_m, alone.results[i].length_m);
    ASSERT_EQ(many.results[i].mode, alone.results[i].mode);
    ASSERT_EQ(many.measures[i], alone.measures[i]);
  }
}

TEST(ModalFlights, CountInWhatFlightsCost) {
  const FlightCosts with = costs_over_all_states(street().plan, 200, 1);
  const FlightCosts without = costs_over_all_states(street_plan(0), 200, 1);
  EXPECT_GT(with.succeeds.value, without.succeeds.value + 0.1);
  EXPECT_EQ(with.states, without.states);
}

}  // namespace
}  // namespace fairway
