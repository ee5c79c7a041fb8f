#include "fairway/run/find_at_risk.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

#include "fairway/behaviour/proved_ends.hpp"
#include "fairway/run/contract_pictures.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/vehicle/filled_commands.hpp"

namespace fairway {
namespace {

/// A rock in the middle of a goalward field, and a contract too loose to pass it everywhere.
Plan rock_plan() {
  Plan plan;
  plan.grid = {24, 20, -5.0, 3.0, 4.0};
  plan.vehicle = {10.0, 9.0};
  plan.heading_rad.resize(plan.grid.size());
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  plan.region.assign(plan.grid.size(), Region::free);
  const Vec2 goal{80.0, 44.0};
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell cell = plan.grid.cell_at(i);
    const Vec2 p = plan.grid.center(cell);
    plan.heading_rad[i] = Heading::stored(std::atan2(goal.y - p.y, goal.x - p.x));
    const bool edge =
        cell.ix == 0 || cell.iy == 0 || cell.ix + 1 == plan.grid.nx || cell.iy + 1 == plan.grid.ny;
    if (edge || norm(p - Vec2{36.0, 42.0}) < 9.0) plan.region[i] = Region::obstacle;
    if (norm(p - goal) < 9.0) plan.region[i] = Region::goal;
    if (plan.region[i] == Region::obstacle) {
      plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return plan;
}

const ContractCertificate& rock_certificate() {
  static const ContractCertificate made = [] {
    const Plan plan = rock_plan();
    VehicleContract contract = VehicleContract::of(plan.vehicle);
    contract.command_error_m = 3.0;
    contract.heading_error_rad = 0.05;
    contract.turn_radius_m = {8.0, 10.0};
    ContractVerifyOptions options;
    options.find_witnesses = false;
    options.samples = 1000;
    return verify_contract(plan, "test", {}, contract, options, [](const std::string&) {})
        .certificate;
  }();
  return made;
}

VerdictMap rock_map() { return contract_verdict_map(rock_certificate(), 12); }

TEST(FindAtRisk, EveryStateAtRiskIsUndecidedAndEveryWitnessFailsFromItsState) {
  const ContractCertificate& certificate = rock_certificate();
  const VerdictMap map = rock_map();
  const PageWitnesses found = find_at_risk(certificate, map);
  ASSERT_EQ(found.at_risk.size(), map.verdict.size());
  EXPECT_EQ(found.not_searched, 0U);
  std::size_t at_risk = 0;
  for (std::size_t k = 0; k < map.verdict.size(); ++k) {
    if (found.at_risk[k] == 0) continue;
    ++at_risk;
    EXPECT_EQ(map.verdict[k], Verdict::undecided);
    EXPECT_EQ(map.kind[k % map.samples()], CellKind::ordinary);
  }
  EXPECT_GT(at_risk, 100U);
  ASSERT_EQ(found.shown.size(), at_risk) << "the page of a small plan has all of them";
  for (const PageWitness& witness : found.shown) {
    EXPECT_EQ(found.at_risk[witness.heading * map.samples() + witness.sample], 1);
    const auto& steps = witness.behaviour.steps;
    ASSERT_FALSE(steps.empty());
    EXPECT_EQ(steps.front().start.position_m, map.place_m(witness.sample));
    EXPECT_EQ(steps.front().start.heading.rad(), map.heading_rad[witness.heading]);
    const Cell end = map.grid.cell_of(witness.behaviour.end.position_m);
    EXPECT_EQ(witness.end, map.grid.contains(end) ? Verdict::collide : Verdict::leave);
    if (map.grid.contains(end)) {
      EXPECT_EQ(certificate.kind[map.grid.index(end)], CellKind::obstacle);
    }
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
      EXPECT_NEAR(steps[i + 1].time_s, steps[i].time_s + steps[i].length_m / 10.0, 1e-12);
      EXPECT_LE(norm(steps[i].command_m - steps[i].start.position_m), 3.0 + 1e-6);
    }
  }
}

TEST(FindAtRisk, WhereNotAllCanBeSearchedOrKeptTheyAreSpreadOverAll) {
  const VerdictMap map = rock_map();
  const PageWitnesses all = find_at_risk(rock_certificate(), map);
  const auto open = static_cast<std::size_t>(std::count_if(
      map.verdict.begin(), map.verdict.end(), [&, k = std::size_t{0}](Verdict v) mutable {
        const bool is_state = map.kind[k++ % map.samples()] == CellKind::ordinary;
        return is_state && v == Verdict::undecided;
      }));
  AtRiskOptions options;
  options.most_searches = open / 2;
  const PageWitnesses half = find_at_risk(rock_certificate(), map, options);
  EXPECT_EQ(half.not_searched, open - open / 2);
  std::size_t first_half = 0;
  for (std::size_t k = 0; k < map.verdict.size(); ++k) {
    EXPECT_LE(half.at_risk[k], all.at_risk[k]);
    if (k < map.verdict.size() / 2) first_half += half.at_risk[k];
  }
  const auto sum = static_cast<std::size_t>(
      std::count(half.at_risk.begin(), half.at_risk.end(), std::uint8_t{1}));
  EXPECT_GT(first_half, sum / 4);
  EXPECT_LT(first_half, 3 * sum / 4);

  options = {};
  options.most_steps = 200;
  const PageWitnesses few = find_at_risk(rock_certificate(), map, options);
  EXPECT_EQ(few.at_risk, all.at_risk);
  EXPECT_GT(few.shown.size(), 0U);
  std::size_t steps = 0;
  for (const PageWitness& witness : few.shown) steps += witness.behaviour.steps.size();
  EXPECT_LE(steps, options.most_steps);
}

TEST(FindAtRisk, AMapWithoutUndecidedStatesNeedsNoSearch) {
  VerdictMap map = rock_map();
  std::fill(map.verdict.begin(), map.verdict.end(), Verdict::reach);
  const PageWitnesses found = find_at_risk(rock_certificate(), map);
  EXPECT_EQ(std::count(found.at_risk.begin(), found.at_risk.end(), std::uint8_t{1}), 0);
  EXPECT_TRUE(found.shown.empty());
}

TEST(ContractVerdictMap, HasTheMoreHeadingsTheFewerCellsThereAre) {
  EXPECT_EQ(contract_verdict_map(rock_certificate()).heading_rad.size(), 8U);
  EXPECT_EQ(contract_verdict_map(rock_certificate(), 12).heading_rad.size(), 12U);
  EXPECT_EQ(contract_verdict_map(rock_certificate(), 36).heading_rad.size(), 36U);
  EXPECT_EQ(contract_verdict_map(rock_certificate(), 72).heading_rad.size(), 72U);
}

}  // namespace
}  // namespace fairway
