#include "fairway/behaviour/find_witness.hpp"

#include <gtest/gtest.h>

#include "fairway/behaviour/behaviour_pilot.hpp"
#include "fairway/behaviour/proved_ends.hpp"
#include "fairway/behaviour/testing/contract_trial.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway {
namespace {

TEST(FindWitness, FindsOneNearlyWhereverTheExactVehicleFails) {
  int failing = 0;
  int found = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    ContractTrial trial = contract_trial(seed);
    const double r = trial.plan.vehicle.turn_radius_m;
    trial.contract.command_error_m = std::max(0.1 * r, trial.contract.command_error_m);
    trial.contract.heading_error_rad = std::max(0.01, trial.contract.heading_error_rad);
    trial.contract.look_ahead_m = 0.0;
    for (float& h : trial.plan.heading_rad) h = std::isnan(h) ? 0.0F : h;
    const PlanFlow held(trial.plan);
    const Flow flow = held.flow();
    const BehaviourChoices choices(flow, trial.contract);
    const FailureGuide guide(choices);
    WitnessSearch search(choices, guide);
    const ExactFlights exact(trial.plan);
    Random random(seed);
    for (int k = 0; k < 30; ++k) {
      const State state = random_state(flow, random);
      const Outcome outcome = exact.fly(state).outcome;
      if (outcome != Outcome::collide && outcome != Outcome::leave) continue;
      ++failing;
      const auto flight = search.find(state);
      if (!flight) continue;
      ++found;
      EXPECT_EQ(flight->start, state);
      EXPECT_TRUE(is_witness(flow, choices.commands(), trial.contract, *flight));
    }
  }
  EXPECT_GT(failing, 500);
  EXPECT_GT(found, failing * 97 / 100) << failing;
}

TEST(FindWitness, FindsWhatAdversariesFind) {
  int failing = 0;
  int found = 0;
  for (std::uint64_t seed = 100; seed < 140; ++seed) {
    const ContractTrial trial = contract_trial(seed);
    const PlanFlow held(trial.plan);
    const Flow flow = held.flow();
    const BehaviourChoices choices(flow, trial.contract);
    const FailureGuide guide(choices);
    WitnessSearch search(choices, guide);
    const BehaviourPilot pilot(choices);
    Random random(seed);
    for (int k = 0; k < 30; ++k) {
      const State state = random_state(flow, random);
      bool fails = false;
      for (int flight = 0; flight < 20 && !fails; ++flight) {
        BehaviourFlight flown{state, {}};
        const auto adversary = adversaries_in_order[random.below(3)];
        pilot.fly(state, adversary, random.bits(), 0.0, &flown.steps);
        fails = is_witness(flow, choices.commands(), trial.contract, flown);
      }
      failing += fails ? 1 : 0;
      found += fails && search.find(state) ? 1 : 0;
    }
  }
  EXPECT_GT(failing, 300);
  EXPECT_GT(found, failing * 95 / 100) << failing;
}

TEST(FindWitness, TheSameStateAndSeedFindTheSameWhateverWasSearchedBefore) {
  const ContractTrial trial = contract_trial(3);
  const PlanFlow held(trial.plan);
  const BehaviourChoices choices(held.flow(), trial.contract);
  const FailureGuide guide(choices);
  WitnessSearch used(choices, guide);
  Random random(3);
  for (int k = 0; k < 40; ++k) {
    const State state = random_state(held.flow(), random);
    const auto first = used.find(state, {}, 5);
    const auto second = WitnessSearch(choices, guide).find(state, {}, 5);
    ASSERT_EQ(first.has_value(), second.has_value());
    if (!first) continue;
    ASSERT_EQ(first->steps.size(), second->steps.size());
    for (std::size_t i = 0; i < first->steps.size(); ++i) {
      EXPECT_EQ(first->steps[i].heading_rad, second->steps[i].heading_rad);
    }
  }
}

TEST(FindWitness, FindsNoneInACorridorThatNoErrorLeaves) {
  // East along a corridor, with a wall two cells away, errors of a tenth of a cell.
  Plan plan = empty_plan(30, 5, 2.0, 5.0);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    if (c.iy == 0 || c.iy == 4) plan.region[i] = Region::obstacle;
    if (c.ix == 29) plan.region[i] = Region::goal;
  }
  const PlanFlow held(plan);
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  contract.command_error_m = 0.2;
  contract.heading_error_rad = 0.02;
  const BehaviourChoices choices(held.flow(), contract);
  const FailureGuide guide(choices);
  WitnessSearch search(choices, guide);
  for (const double x : {3.0, 20.0, 50.0}) {
    EXPECT_FALSE(search.find({{x, 5.0}, Heading::from_rad(0.0)}));
  }
  // With an error of heading that can carry it there, there is one.
  contract.heading_error_rad = 0.12;
  const BehaviourChoices loose(held.flow(), contract);
  const FailureGuide loose_guide(loose);
  EXPECT_TRUE(WitnessSearch(loose, loose_guide).find({{3.0, 5.0}, Heading::from_rad(0.0)}));
}

TEST(FindWitness, OppositeHeadingsCornersAndNoErrorAreNoTrouble) {
  Plan plan = empty_plan(12, 12, 2.0, 5.0);
  for (float& h : plan.heading_rad) h = 0.0F;
  plan.region[plan.grid.index({6, 11})] = Region::obstacle;
  const PlanFlow held(plan);
  for (const double error : {0.0, 0.05}) {
    VehicleContract contract = VehicleContract::of(plan.vehicle);
    contract.heading_error_rad = error;
    const BehaviourChoices choices(held.flow(), contract);
    const FailureGuide guide(choices);
    WitnessSearch search(choices, guide);
    for (const Vec2 p : {Vec2{12.0, 12.0}, Vec2{0.0, 0.0}, Vec2{12.0, 22.0}, Vec2{24.0, 3.0},
                         Vec2{11.0, 11.0}, Vec2{1e300, 0.0}}) {
      for (const double h : {0.0, pi, -pi / 2, pi / 2, 1.0}) {
        const auto flight = search.find({p, Heading::from_rad(h)});
        if (flight) {
          EXPECT_TRUE(is_witness(held.flow(), choices.commands(), contract, *flight));
        }
      }
    }
    // West, with commands to the east: the grid is left, by a turn or before it ends.
    EXPECT_EQ(search.find({{1.0, 11.0}, Heading::from_rad(pi)}).has_value(), error > 0.0);
  }
}

TEST(FindWitness, APlanWithoutAnyCommandHasNoWitnessButThatOfTheStart) {
  Plan plan = empty_plan(5, 5, 1.0, 2.0);
  for (float& h : plan.heading_rad) h = std::numeric_limits<float>::quiet_NaN();
  plan.region[plan.grid.index({2, 2})] = Region::obstacle;
  const PlanFlow held(plan);
  const BehaviourChoices choices(held.flow(), VehicleContract::of(plan.vehicle));
  const FailureGuide guide(choices);
  WitnessSearch search(choices, guide);
  EXPECT_FALSE(search.find({{0.5, 0.5}, Heading::from_rad(0.0)}));
  EXPECT_TRUE(search.find({{2.5, 2.5}, Heading::from_rad(0.0)}));
}

}  // namespace
}  // namespace fairway
