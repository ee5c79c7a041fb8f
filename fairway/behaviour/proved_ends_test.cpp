#include "fairway/behaviour/proved_ends.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "fairway/behaviour/behaviour_pilot.hpp"
#include "fairway/behaviour/testing/contract_trial.hpp"

namespace fairway {
namespace {

bool failed(const BehaviourRun& run) {
  return run.outcome == Outcome::collide || run.outcome == Outcome::leave;
}

/// Whether the command of some point within the error, at this very instant, lets the vehicle turn
/// so: by brute force over points and errors, in the words of vehicle/contract.hpp.
class Instant {
 public:
  Instant(const BehaviourChoices& choices, Vec2 place, double heading_rad)
      : choices_(choices), place_(place), heading_rad_(heading_rad) {}

  /// `held`: the sides that may have been held before, those that may be held afterwards; none is
  /// left when no command allows the turn.
  void go_on(int turn, std::set<int>& held) const {
    const VehicleContract& contract = choices_.contract();
    const Grid& g = choices_.flow().grid;
    const Vec2 ahead =
        place_ + contract.look_ahead_m * Vec2{std::cos(heading_rad_), std::sin(heading_rad_)};
    std::set<int> after;
    for (std::size_t cell = 0; cell < g.size(); ++cell) {
      const Vec2 low = g.corner(g.cell_at(cell));
      const Vec2 apart{ahead.x - std::clamp(ahead.x, low.x, low.x + g.cell_m),
                       ahead.y - std::clamp(ahead.y, low.y, low.y + g.cell_m)};
      if (norm(apart) > contract.command_error_m + 1e-9) continue;
      for (int k = -8; k <= 8; ++k) {
        const double command =
            static_cast<double>(choices_.commands()[cell]) + contract.heading_error_rad * k / 8.0;
        go_on_under(command, turn, held, after);
      }
    }
    held = after;
  }

 private:
  void go_on_under(double command, int turn, const std::set<int>& held,
                   std::set<int>& after) const {
    const VehicleContract& contract = choices_.contract();
    const double fuzzy = 1e-9 + contract.heading_error_rad / 8.0;
    const double off = std::remainder(command - heading_rad_, two_pi);
    if (turn == 0 || (off * turn < 0.0 && std::abs(off) <= fuzzy)) {
      if (std::abs(off) <= fuzzy) after.insert(0);
      return;
    }
    const double to = off * turn < 0.0 ? two_pi - std::abs(off) : std::abs(off);
    if (to <= contract.hold_side_rad) {
      after.insert(0);
      return;
    }
    for (const int side : held) {
      const double most = side == turn ? two_pi : pi + contract.side_uncertain_rad;
      if (side != -turn && to <= std::min(most, two_pi - contract.hold_side_rad) + fuzzy) {
        after.insert(turn);
        if (to <= contract.hold_side_rad + fuzzy) after.insert(0);
      }
    }
  }

  const BehaviourChoices& choices_;
  Vec2 place_;
  double heading_rad_;
};

TEST(ProvedEnds, WhatAPilotFliesIsAcceptedAndEndsAsItSays) {
  int accepted = 0;
  int failing = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const ContractTrial trial = contract_trial(seed);
    const PlanFlow held(trial.plan);
    const Flow flow = held.flow();
    const BehaviourChoices choices(flow, trial.contract);
    const BehaviourPilot pilot(choices);
    Random random(seed);
    for (int k = 0; k < 30; ++k) {
      BehaviourFlight flight{random_state(flow, random), {}};
      const Adversary adversary = adversaries_in_order[random.below(3)];
      const auto run = pilot.fly(flight.start, adversary, random.bits(), 0.0, &flight.steps);
      if (!run.proved || run.outcome == Outcome::trapped) continue;
      const ProvedEnds proved = proved_ends(flow, choices.commands(), trial.contract, flight);
      ASSERT_TRUE(proved.admissible) << "plan " << seed << ", flight " << k;
      EXPECT_NEAR(proved.length_m, run.length_m, 1e-6 * (1.0 + run.length_m));
      ++accepted;
      if (!failed(run)) continue;
      ++failing;
      EXPECT_TRUE(proved.may_be(static_cast<Verdict>(run.outcome)));
      EXPECT_TRUE(is_witness(flow, choices.commands(), trial.contract, flight));
    }
  }
  EXPECT_GT(accepted, 800);
  EXPECT_GT(failing, 300);
}

TEST(ProvedEnds, AnAcceptedFlightKeepsTheContractAtEveryInstant) {
  int instants = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const ContractTrial trial = contract_trial(seed);
    const PlanFlow held_plan(trial.plan);
    const Flow flow = held_plan.flow();
    const BehaviourChoices choices(flow, trial.contract);
    const BehaviourPilot pilot(choices);
    Random random(seed);
    for (int k = 0; k < 6; ++k) {
      BehaviourFlight flight{random_state(flow, random), {}};
      pilot.fly(flight.start, adversaries_in_order[random.below(3)], random.bits(), 0.0,
                &flight.steps);
      if (flight.steps.size() > 60) flight.steps.resize(60);
      if (!proved_ends(flow, choices.commands(), trial.contract, flight).admissible) continue;
      Vec2 place = flight.start.position_m;
      double heading = flight.start.heading.rad();
      std::set<int> held{0};
      for (const BehaviourStep& step : flight.steps) {
        const double angle =
            step.turn == 0 ? 0.0 : turn_angle(heading, step.heading_rad, step.turn);
        for (const double share : {0.02, 0.3, 0.6, 0.98}) {
          BehaviourStep part = step;
          part.length_m = share * step.length_m;
          part.heading_rad = Heading::from_rad(heading + step.turn * share * angle).rad();
          const Vec2 at = place + move_of(part, heading);
          if (flow.kind_at(flow.grid.cell_of(at)) != CellKind::ordinary) break;  // it has ended
          const Instant instant(choices, at, part.heading_rad);
          instant.go_on(step.turn, held);
          ASSERT_FALSE(held.empty()) << "plan " << seed << ", flight " << k;
          ++instants;
        }
        place = place + move_of(step, heading);
        heading = step.heading_rad;
      }
    }
  }
  EXPECT_GT(instants, 10000);
}

/// A wall north of a vehicle that flies east, with commands that point at the wall in every other
/// column: whoever takes those turns into it.
struct Wall {
  Wall() : plan(empty_plan(20, 8, 2.0, 5.0)), held(prepared(plan)), flow(held.flow()) {
    contract = VehicleContract::of(plan.vehicle);
    contract.command_error_m = 1.5;
    contract.heading_error_rad = 0.02;
    contract.turn_radius_m = {4.5, 5.5};
  }
  static const Plan& prepared(Plan& plan) {
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      const Cell c = plan.grid.cell_at(i);
      plan.heading_rad[i] = c.ix % 2 == 0 ? 0.0F : 1.2F;
      if (c.iy == 7) plan.region[i] = Region::obstacle;
      if (c.ix == 19) plan.region[i] = Region::goal;
    }
    return plan;
  }
  Plan plan;
  PlanFlow held;
  Flow flow;
  VehicleContract contract;
};

TEST(ProvedEnds, ATamperedFlightIsRefused) {
  const Wall wall;
  const BehaviourChoices choices(wall.flow, wall.contract);
  const BehaviourPilot pilot(choices);
  const State start{{3.0, 9.0}, Heading::from_rad(0.0)};
  BehaviourFlight flight{start, {}};
  std::uint64_t seed = 0;
  do {
    flight.steps.clear();
  } while (!failed(pilot.fly(start, Adversary::greedy, ++seed, 0.0, &flight.steps)) && seed < 200);
  const auto accepts = [&](const BehaviourFlight& f) {
    return is_witness(wall.flow, choices.commands(), wall.contract, f);
  };
  ASSERT_TRUE(accepts(flight));
  std::size_t turn = 0;
  while (flight.steps[turn].turn == 0) ++turn;
  const auto refused = [&](const std::string& why, const auto& change) {
    BehaviourFlight tampered = flight;
    change(tampered.steps);
    EXPECT_FALSE(accepts(tampered)) << why;
  };
  using Steps = std::vector<BehaviourStep>;
  const double nan = std::nan("");
  refused("a radius too small", [&](Steps& s) { s[turn].radius_m = 4.4999; });
  refused("a radius too great", [&](Steps& s) { s[turn].radius_m = 5.5001; });
  refused("no number", [&](Steps& s) { s[turn].radius_m = nan; });
  refused("no heading", [&](Steps& s) { s[turn].heading_rad = nan; });
  refused("a heading out of range", [&](Steps& s) { s[turn].heading_rad += two_pi; });
  refused("the other side", [&](Steps& s) { s[turn].turn = -s[turn].turn; });
  refused("no side at all", [&](Steps& s) { s[turn].turn = 2; });
  refused("too great an error", [&](Steps& s) { s[turn].error_rad = 0.03; });
  refused("the command of a far cell", [&](Steps& s) { s[turn].cell = 18; });
  refused("a cell that is not there", [&](Steps& s) { s[turn].cell = 100000; });
  refused("straight, off the command", [&](Steps& s) {
    s[turn] = {0, 0.0, 0.5, turn == 0 ? 0.0 : s[turn - 1].heading_rad, s[turn].cell, 0.0};
    s[turn].heading_rad += 0.5;
  });
  refused("a longer turn than the command allows", [&](Steps& s) { s[turn].heading_rad += 1.5; });
  refused("an end before the wall", [&](Steps& s) { s.pop_back(); });
  refused("an end in front of the wall", [&](Steps& s) { s.resize(1); });
}

TEST(ProvedEnds, AFlightThroughTheGoalProvesNoFailure) {
  Wall wall;
  const std::size_t cells = wall.plan.grid.size();
  const BehaviourChoices choices(wall.flow, wall.contract);
  const State start{{3.0, 9.0}, Heading::from_rad(0.0)};
  const BehaviourPilot pilot(choices);
  int turned = 0;
  for (std::uint64_t seed = 1; seed < 40; ++seed) {
    BehaviourFlight flight{start, {}};
    if (!failed(pilot.fly(start, Adversary::greedy, seed, 0.0, &flight.steps))) continue;
    ASSERT_TRUE(is_witness(wall.flow, choices.commands(), wall.contract, flight));
    // The cell half-way becomes a goal: the flight reaches first.
    std::vector<CellKind> kind(wall.flow.kind, wall.flow.kind + cells);
    Vec2 place = start.position_m;
    double heading = start.heading.rad();
    for (std::size_t k = 0; k < flight.steps.size() / 2; ++k) {
      place = place + move_of(flight.steps[k], heading);
      heading = flight.steps[k].heading_rad;
    }
    kind[wall.plan.grid.index(wall.plan.grid.cell_of(place))] = CellKind::target;
    Flow other = wall.flow;
    other.kind = kind.data();
    EXPECT_FALSE(is_witness(other, choices.commands(), wall.contract, flight));
    ++turned;
  }
  EXPECT_GT(turned, 3);
}

TEST(ProvedEnds, ASideOnceTakenIsKeptWhileTheCommandIsBehind) {
  // Commands point west; the vehicle flies east. Either turn may begin, but not change.
  Plan plan = empty_plan(40, 40, 2.0, 5.0);
  for (float& h : plan.heading_rad) h = 3.1415925F;
  const PlanFlow held(plan);
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  contract.heading_error_rad = 0.05;
  const BehaviourChoices choices(held.flow(), contract);
  const auto turn = [](int side, double to_rad, double error_rad) {
    return BehaviourStep{side, 5.0, 0.0, to_rad, own_cell, error_rad};
  };
  const auto admissible = [&](std::vector<BehaviourStep> steps) {
    const BehaviourFlight flight{{{41.0, 41.0}, Heading::from_rad(0.0)}, std::move(steps)};
    return proved_ends(held.flow(), choices.commands(), contract, flight).admissible;
  };
  EXPECT_TRUE(admissible({turn(1, 0.01, -0.04)}));
  EXPECT_TRUE(admissible({turn(-1, -0.01, 0.04)}));
  EXPECT_TRUE(admissible({turn(1, 0.01, -0.04), turn(1, 0.03, 0.04)}));
  EXPECT_FALSE(admissible({turn(1, 0.01, -0.04), turn(-1, 0.005, 0.04)}));
  EXPECT_FALSE(admissible({turn(-1, -0.01, 0.04), turn(1, -0.005, -0.04)}));
}

TEST(ProvedEnds, StatesAtCornersAndFarAwayAreNoTrouble) {
  const Wall wall;
  const BehaviourChoices choices(wall.flow, wall.contract);
  for (const Vec2 p : {Vec2{0.0, 0.0}, Vec2{2.0, 14.0}, Vec2{40.0, 16.0}, Vec2{1e300, 0.0},
                       Vec2{std::nan(""), 1.0}, Vec2{-1e-16, 5.0}}) {
    const BehaviourFlight still{{p, Heading::from_rad(1.0)}, {}};
    EXPECT_FALSE(is_witness(wall.flow, choices.commands(), wall.contract, still));
  }
  // Surely in the wall, surely outside.
  for (const Vec2 p : {Vec2{3.0, 15.0}, Vec2{-1.0, 5.0}}) {
    const BehaviourFlight still{{p, Heading::from_rad(1.0)}, {}};
    EXPECT_TRUE(is_witness(wall.flow, choices.commands(), wall.contract, still));
  }
}

}  // namespace
}  // namespace fairway
