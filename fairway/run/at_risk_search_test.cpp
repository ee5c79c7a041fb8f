// The share at risk: counted when all undecided states were searched from, scaled from a fair
// sample when there was no time for all.
#include "fairway/run/at_risk_search.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"
#include "fairway/run/ask_contract.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

std::vector<State> some_states(std::size_t count) {
  Random random(4);
  std::vector<State> states;
  for (std::size_t k = 0; k < count; ++k) {
    states.push_back({{random.unit(), random.unit()}, Heading::from_rad(random.uniform(-pi, pi))});
  }
  return states;
}

TEST(UndecidedStates, ComeInAnOrderThatIsNotThatOfGathering) {
  const std::vector<State> states = some_states(500);
  const auto ordered = [&](bool backwards, std::uint64_t seed) {
    UndecidedStates gathered;
    const IsAtRisk note = gathered.gatherer()();
    std::vector<State> way = states;
    if (backwards) std::reverse(way.begin(), way.end());
    for (const State& state : way) EXPECT_FALSE(note(state));
    return gathered.in_random_order(seed);
  };
  EXPECT_EQ(ordered(false, 1), ordered(true, 1));
  EXPECT_NE(ordered(false, 1), ordered(false, 2));
  // No part of the map comes first.
  const auto shuffled = ordered(false, 1);
  double sum = 0.0;
  for (std::size_t k = 0; k < 100; ++k) sum += shuffled[k].position_m.y;
  EXPECT_NEAR(sum / 100.0, 0.5, 0.12);
}

TEST(AtRiskShares, AreCountedOrScaled) {
  ContractShares shares;
  shares.all[0] = 0.3;
  shares.free[0] = 0.2;
  EXPECT_TRUE(add_at_risk(shares, 3000, {3000, 1000, 600, 100}));
  EXPECT_DOUBLE_EQ(shares.at_risk, 0.06);
  EXPECT_DOUBLE_EQ(shares.at_risk_free, 0.02);
  EXPECT_TRUE(add_at_risk(shares, 3000, {1000, 500, 100, 25}));
  EXPECT_DOUBLE_EQ(shares.at_risk, 0.03);
  EXPECT_DOUBLE_EQ(shares.at_risk_free, 0.01);
  EXPECT_FALSE(add_at_risk(shares, 3000, {100, 50, 10, 5})) << "too few to tell";
  EXPECT_TRUE(add_at_risk(shares, 100, {100, 50, 10, 5})) << "few, but all";
  EXPECT_TRUE(add_at_risk(shares, 0, {}));
  EXPECT_EQ(shares.at_risk, 0.0);
}

TEST(FailureSearch, FindsWhatAQueryFindsAndStopsWhenTold) {
  const Plan plan = random_plan(5);
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  contract.command_error_m = 0.3 * plan.grid.cell_m;
  contract.heading_error_rad = 0.03;
  ContractVerifyOptions options;
  options.samples = 1000;
  options.find_witnesses = false;
  const ContractCertificate certificate =
      verify_contract(plan, "the plan", {}, contract, options, [](const std::string&) {
      }).certificate;
  std::vector<State> states;
  Random random(6);
  const Grid& grid = plan.grid;
  while (states.size() < 60) {
    const State state{
        {grid.x0_m + random.unit() * grid.width_m(), grid.y0_m + random.unit() * grid.height_m()},
        Heading::from_rad(random.uniform(-pi, pi))};
    if (ask(certificate, std::span(&state, 1)).front().verdict == Verdict::undecided) {
      states.push_back(state);
    }
  }
  const auto replies = ask(certificate, states);
  const auto at_risk = std::count_if(replies.begin(), replies.end(),
                                     [](const ContractReply& r) { return r.witness.has_value(); });
  const FailureSearch search(certificate);
  const RiskCount all = search.count(states, 1, [] { return true; });
  EXPECT_EQ(all.asked, states.size());
  EXPECT_EQ(all.at_risk, static_cast<std::size_t>(at_risk));
  EXPECT_GT(all.at_risk, 0U);
  EXPECT_EQ(search.count(states, 1, [] { return false; }).asked, 0U);
  std::atomic<int> left{20};
  const RiskCount some = search.count(states, 1, [&] { return left-- > 0; });
  EXPECT_GT(some.asked, 0U);
  EXPECT_LT(some.asked, 21U);
}

}  // namespace
}  // namespace fairway
