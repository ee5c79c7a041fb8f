#include "tests/falsify/contract_attack.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fairway/behaviour/testing/contract_trial.hpp"
#include "tests/falsify/contract_proof.hpp"
#include "tests/falsify/cut_flight.hpp"

namespace fairway {
namespace {

TEST(ContractAttack, ContradictsWhatIsFalse) {
  int contradicted = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const ContractTrial trial = contract_trial(seed);
    const PlanFlow held(trial.plan);
    ContractAttackOptions options;
    options.flights = 2000;
    for (const Verdict claim : {Verdict::reach, Verdict::collide, Verdict::trapped}) {
      const auto claims = [&](const State&) { return ContractClaim{claim, 1e9}; };
      const auto totals = attack("all", held.flow(), trial.contract, claims, options);
      EXPECT_GE(totals.flights, options.flights);
      contradicted += totals.contradictions > 0 ? 1 : 0;
      EXPECT_EQ(totals.stories.empty(), totals.contradictions + totals.late == 0);
    }
  }
  EXPECT_GE(contradicted, 15);
}

TEST(ContractAttack, FindsBoundsOfTimeThatAreTooShort) {
  Plan plan = empty_plan(20, 9, 2.0, 5.0);
  for (int iy = 0; iy < 9; ++iy) plan.region[plan.grid.index({19, iy})] = Region::goal;
  const PlanFlow held(plan);
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  contract.command_error_m = 1.0;
  contract.heading_error_rad = 0.01;
  ContractAttackOptions options;
  options.flights = 2000;
  const auto claims = [&](const State&) { return ContractClaim{Verdict::reach, 0.5}; };
  EXPECT_GT(attack("late", held.flow(), contract, claims, options).late, 100U);
}

TEST(ContractAttack, ContradictsNothingWhereNothingIsClaimed) {
  const ContractTrial trial = contract_trial(1);
  const PlanFlow held(trial.plan);
  ContractAttackOptions options;
  options.flights = 500;
  const auto claims = [](const State&) { return ContractClaim{}; };
  const auto totals = attack("none", held.flow(), trial.contract, claims, options);
  EXPECT_EQ(totals.flights, 0U);
  EXPECT_EQ(totals.contradictions + totals.late, 0U);
}

TEST(ContractAttack, EndsWhenItIsToldTo) {
  const ContractTrial trial = contract_trial(1);
  const PlanFlow held(trial.plan);
  ContractAttackOptions options;
  options.flights = 1000000000;
  std::uint64_t told = 0;
  options.progress = [&told](std::uint64_t flights, std::uint64_t) {
    told = flights;
    return flights < 3000;
  };
  const auto claims = [](const State&) { return ContractClaim{Verdict::collide, 0.0}; };
  const auto totals = attack("told", held.flow(), trial.contract, claims, options);
  EXPECT_GE(told, 3000U);
  EXPECT_GE(totals.flights, told);
  EXPECT_LT(totals.flights, 30000U);
}

TEST(ContractAttack, CutsFlightsWhereStepsPassACorner) {
  Plan plan = empty_plan(9, 9, 2.0, 5.0);
  plan.region[plan.grid.index({4, 4})] = Region::obstacle;
  const PlanFlow held(plan);
  const BehaviourChoices choices(held.flow(), VehicleContract::of(plan.vehicle));
  // Straight over the corner at (8, 8): from and to ordinary cells, in one step.
  const State start{{7.5, 8.7}, Heading::from_rad(-0.25 * pi)};
  const BehaviourFlight over{start, {{0, 0.0, 2.0, -0.25 * pi, own_cell, 0.0}}};
  EXPECT_EQ(choices.surely_in({7.5 + std::sqrt(2.0), 8.7 - std::sqrt(2.0)}), CellKind::ordinary);
  const CutFlight cut = until_it_ends(choices, over);
  EXPECT_EQ(cut.end, CellKind::obstacle);
  ASSERT_EQ(cut.flight.steps.size(), 1U);
  EXPECT_LT(cut.flight.steps[0].length_m, 1.5);
  const BehaviourFlight beside{{{5.0, 7.0}, Heading::from_rad(-0.25 * pi)}, over.steps};
  EXPECT_EQ(until_it_ends(choices, beside).end, CellKind::ordinary);
  EXPECT_EQ(until_it_ends(choices, beside).flight.steps.size(), 1U);
}

TEST(ContractAttack, ContradictsAProofThatWasMadeForASteadierVehicle) {
  // What a prover would claim that left out one of the errors.
  const auto contradictions = [](const auto& steadier) {
    std::uint64_t found = 0;
    for (std::uint64_t seed = 203; seed < 206; ++seed) {
      ContractTrial trial = contract_trial(seed);
      const double r = trial.plan.vehicle.turn_radius_m;
      trial.contract = VehicleContract::of(trial.plan.vehicle);
      trial.contract.command_error_m = 0.25 * r;
      trial.contract.heading_error_rad = 0.08;
      trial.contract.turn_radius_m = {0.75 * r, 1.3 * r};
      VehicleContract proved = trial.contract;
      steadier(proved, r);
      const PlanFlow held(trial.plan);
      const ContractProof proof(held.flow(), proved, 2, 3, 1e9);
      ContractAttackOptions options;
      options.flights = 2000;
      found += attack(
                   "steadier", held.flow(), trial.contract,
                   [&](const State& s) { return proof.claim(s); }, options)
                   .contradictions;
    }
    return found;
  };
  EXPECT_GT(contradictions([](VehicleContract& c, double) { c.command_error_m = 0.0; }), 0U);
  EXPECT_GT(contradictions([](VehicleContract& c, double) { c.heading_error_rad = 0.0; }), 0U);
  EXPECT_GT(contradictions([](VehicleContract& c, double r) {
              c.turn_radius_m = {r, 1.3 * r};
            }),
            0U);
  EXPECT_GT(contradictions([](VehicleContract& c, double r) {
              c.turn_radius_m = {0.75 * r, r};
            }),
            0U);
  // And nothing contradicts the proof itself.
  EXPECT_EQ(contradictions([](VehicleContract&, double) {}), 0U);
}

}  // namespace
}  // namespace fairway
