// Failures from safe starts with a command come first, and no flown one is lost.
#include "fairway/run/failing_states.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "fairway/run/failing_flights.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/simulate/start_states.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

/// Some cells of a random plan lose their command, as if they were cut off.
Plan plan_with_a_pocket(std::uint64_t seed) {
  Plan plan = random_plan(seed);
  for (std::size_t i = 0; i < plan.region.size(); i += 3) {
    if (plan.region[i] != Region::free) continue;
    plan.heading_rad[i] = std::nanf("");
    plan.cost_m[i] = INFINITY;
  }
  return plan;
}

Certificate certificate_of(const Plan& plan) {
  CertifyOptions options;
  options.samples = 1000;
  options.last_level = 5;
  return verify_plan(plan, "the plan", {}, options).certificate;
}

bool has_start(const FailingState& state, const State& start) {
  return state.start.position_m == start.position_m &&
         state.start.heading.rad() == start.heading.rad();
}

TEST(FailingStates, ComeByGroundThenByVerdict) {
  std::map<StartGround, std::size_t> on_ground;
  for (std::uint64_t seed = 11; seed < 15; ++seed) {
    const Plan plan = plan_with_a_pocket(seed);
    std::map<std::pair<int, long>, std::size_t> count;
    std::pair<int, long> last{0, 0};
    for (const FailingState& state : failing_states(certificate_of(plan), 10, 3)) {
      const std::size_t cell = plan.grid.index(plan.grid.cell_of(state.start.position_m));
      EXPECT_EQ(state.ground == StartGround::cut_off, std::isnan(plan.heading_rad[cell]));
      EXPECT_TRUE(state.ground == StartGround::cut_off ||
                  (state.ground == StartGround::buffer) == (plan.region[cell] == Region::buffer));
      EXPECT_NE(state.verdict, Verdict::reach);
      const auto* rank =
          std::find(verdicts_in_order.begin(), verdicts_in_order.end(), state.verdict);
      const std::pair<int, long> here{static_cast<int>(state.ground),
                                      rank - verdicts_in_order.begin()};
      EXPECT_LE(last, here);
      last = here;
      EXPECT_LE(++count[here], 10U);
      ++on_ground[state.ground];
    }
  }
  EXPECT_GT(on_ground[StartGround::safe_start], 0U);
  EXPECT_GT(on_ground[StartGround::cut_off], 0U);
}

TEST(FailingStates, BeginWithTheStartsOfFlightsThatFailed) {
  const Plan plan = plan_with_a_pocket(12);
  const Certificate certificate = certificate_of(plan);
  const ExactFlights flights(plan);
  std::vector<State> starts = random_states(plan, StartRegion::safe_start, 500, 9);
  std::vector<FlightResult> results;
  for (const State& start : starts) results.push_back(flights.fly(start));
  const std::vector<State> failed = failing_starts(starts, results);
  ASSERT_FALSE(failed.empty());
  const auto failing = failing_states(certificate, 1000, 3, failed);
  std::size_t found = 0;
  for (const State& start : failed) {
    const auto at = std::find_if(failing.begin(), failing.end(), [&](const FailingState& state) {
      return has_start(state, start);
    });
    ASSERT_NE(at, failing.end());
    EXPECT_TRUE(at->flown);
    ++found;
    // What stands before it, of its ground and verdict, is flown, too.
    for (auto before = failing.begin(); before != at; ++before) {
      if (before->ground == at->ground && before->verdict == at->verdict) {
        EXPECT_TRUE(before->flown);
      }
    }
  }
  EXPECT_EQ(found, failed.size());
}

TEST(FailingStates, AreWrittenWithTheirGround) {
  const std::string text = failing_states_csv(
      {{{{1.0, 2.0}, Heading::from_rad(0.5)}, Verdict::collide, StartGround::cut_off}});
  EXPECT_EQ(text, "x_m,y_m,heading_rad,verdict,start\n1,2,0.5,collide,cut_off\n");
}

TEST(FailingFlights, AreFlownOnesFirstThenTheLongest) {
  const Plan plan = plan_with_a_pocket(12);
  auto failing = failing_states(certificate_of(plan), 30, 3);
  ASSERT_EQ(failing.front().ground, StartGround::safe_start);
  FailingState* last_of_kind = &failing.front();
  for (FailingState& state : failing) {
    if (state.ground == failing.front().ground && state.verdict == failing.front().verdict) {
      last_of_kind = &state;
    }
  }
  last_of_kind->flown = true;
  const State flown = last_of_kind->start;
  const ExactFlights flights(plan);
  const auto grounds = failing_flights(flights, failing, 3);
  ASSERT_FALSE(grounds.empty());
  EXPECT_EQ(grounds.front().ground, StartGround::safe_start);
  EXPECT_EQ(grounds.front().flights.front().start.position_m, flown.position_m);
  for (const FailingFlights& ground : grounds) {
    std::map<Outcome, std::vector<double>> lengths;
    for (const Flight& flight : ground.flights) {
      EXPECT_NE(flight.result.outcome, Outcome::reach);
      if (flight.start.position_m == flown.position_m) continue;
      lengths[flight.result.outcome].push_back(flight.result.length_m);
    }
    for (const auto& [outcome, of] : lengths) {
      EXPECT_LE(of.size(), 3U);
      EXPECT_TRUE(std::is_sorted(of.rbegin(), of.rend()));
    }
  }
  EXPECT_GE(all_flights(grounds).size(), grounds.size());
}

}  // namespace
}  // namespace fairway
