#include "fairway/inclusion/inclusion_prover.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "fairway/base/random.hpp"
#include "fairway/inclusion/contract_lookup.hpp"
#include "fairway/inclusion/testing/behaviour.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

struct Proof {
  Proof(const Flow& flow, const VehicleContract& contract, int per_cell,
        const InclusionLimits& limits = {})
      : parts(flow, contract, per_cell) {
    InclusionProver prover(parts, limits);
    prover.run([](const InclusionLevel&) {});
    verdicts = prover.verdicts(contract.speed_mps.least);
    speed_mps = contract.speed_mps.least;
  }
  ContractAnswer at(Vec2 place_m, double heading_rad) const {
    return contract_answer(parts, verdicts, speed_mps, (1.0 / parts.part_m()) * place_m,
                           heading_rad);
  }

  Parts parts;
  ContractVerdicts verdicts;
  double speed_mps = 0.0;
};

Plan plan_to_a_goal(Random& random) {
  Plan plan = empty_plan(16, 14, 1.0, random.uniform(1.3, 3.0));
  const Vec2 goal{random.uniform(4.0, 12.0), random.uniform(4.0, 10.0)};
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    const Vec2 to = goal - plan.grid.center(c);
    plan.heading_rad[i] = static_cast<float>(std::atan2(to.y, to.x));
    if (norm2(to) < 4.0) plan.region[i] = Region::goal;
    if (norm2(to) >= 9.0 && random.below(30) == 0) plan.region[i] = Region::obstacle;
    if (plan.region[i] == Region::obstacle) {
      plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return plan;
}

VehicleContract some_contract(Random& random, const Vehicle& vehicle) {
  VehicleContract contract = VehicleContract::of(vehicle);
  const double r = vehicle.turn_radius_m;
  contract.command_error_m = random.below(3) == 0 ? 0.0 : random.uniform(0.0, 0.6);
  contract.heading_error_rad = random.below(3) == 0 ? 0.0 : random.uniform(0.0, 0.06);
  if (random.below(3) != 0) contract.turn_radius_m = {0.9 * r, 1.1 * r};
  if (random.below(4) == 0) contract.side_uncertain_rad = random.uniform(0.0, 0.3);
  return contract;
}

/// How one behaviour ends within `most_m`, and after which way; undecided: not at all.
std::pair<Verdict, double> fly(const Parts& parts, Behaviour& behaviour, double most_m) {
  const double m = parts.part_m();
  const double step = 0.02 * m;
  for (double way = 0.0; way < most_m; way += step) {
    const Vec2 p = behaviour.place();
    switch (parts.kind(
        {static_cast<int>(std::floor(p.x / m)), static_cast<int>(std::floor(p.y / m))})) {
      case PartKind::obstacle:
        return {Verdict::collide, way};
      case PartKind::outside:
        return {Verdict::leave, way};
      case PartKind::goal:
        return {Verdict::reach, way};
      default:
        behaviour.step(step);
    }
  }
  return {Verdict::undecided, most_m};
}

TEST(InclusionProver, NoBehaviourContradictsAVerdict) {
  Random random(5);
  std::array<int, verdict_count> seen{};
  for (int round = 0; round < 24; ++round) {
    const Plan plan = plan_to_a_goal(random);
    const VehicleContract contract = some_contract(random, plan.vehicle);
    const PlanFlow held(plan);
    const Flow flow = held.flow();
    const Proof proof(flow, contract, 1 + static_cast<int>(random.below(2)));
    const auto commands = filled_commands(flow.grid, flow.heading_rad);
    for (int k = 0; k < 60; ++k) {
      const Vec2 p{random.uniform(0.0, 16.0), random.uniform(0.0, 14.0)};
      const double heading = random.uniform(-pi, pi);
      const ContractAnswer answer = proof.at(p, heading);
      ++seen[static_cast<std::size_t>(answer.verdict)];
      if (answer.verdict == Verdict::undecided) continue;
      for (int flight = 0; flight < 12; ++flight) {
        Behaviour behaviour(flow, commands, contract, p, heading, random.bits());
        const double most_m = answer.verdict == Verdict::trapped
                                  ? 300.0
                                  : answer.worst_time_s * contract.speed_mps.least;
        const auto [end, way] = fly(proof.parts, behaviour, most_m + 1.0);
        const Verdict expected =
            answer.verdict == Verdict::trapped ? Verdict::undecided : answer.verdict;
        ASSERT_EQ(end, expected) << "round " << round << ", state " << p.x << ", " << p.y << ", "
                                 << heading << " after " << way << " m";
      }
    }
  }
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::reach)], 400);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::collide)], 30);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::leave)], 10);
}

TEST(InclusionProver, StatesOnBordersAndCornersAreNotContradicted) {
  Random random(8);
  int decided = 0;
  for (int round = 0; round < 16; ++round) {
    const Plan plan = plan_to_a_goal(random);
    const VehicleContract contract = some_contract(random, plan.vehicle);
    const PlanFlow held(plan);
    const Flow flow = held.flow();
    const Proof proof(flow, contract, 1);
    const auto commands = filled_commands(flow.grid, flow.heading_rad);
    for (int k = 0; k < 80; ++k) {
      // On a border of leaves, often on a corner; often along a side.
      const Vec2 p{0.5 * static_cast<double>(2 + random.below(28)),
                   0.5 * static_cast<double>(2 + random.below(24))};
      const double heading =
          std::remainder(0.25 * pi * static_cast<double>(random.below(8)), 2.0 * pi);
      const ContractAnswer answer = proof.at(p, heading);
      if (answer.verdict == Verdict::undecided || answer.verdict == Verdict::trapped) continue;
      ++decided;
      for (int flight = 0; flight < 12; ++flight) {
        Behaviour behaviour(flow, commands, contract, p, heading, random.bits());
        const double most_m = answer.worst_time_s * contract.speed_mps.least + 1.0;
        ASSERT_EQ(fly(proof.parts, behaviour, most_m).first, answer.verdict)
            << "round " << round << ", state " << p.x << ", " << p.y << ", " << heading;
      }
    }
  }
  EXPECT_GT(decided, 300);
}

TEST(InclusionProver, SomethingComesAfterEveryLeaf) {
  // A leaf is never empty, so an image without an end or a crossing would have lost someone: with
  // arcs that end just beside the direction of a side, sets stay within the slack of its places.
  Random random(9);
  int flown = 0;
  for (int round = 0; round < 30; ++round) {
    Plan plan = plan_to_a_goal(random);
    for (float& command : plan.heading_rad) {
      if (std::isnan(command) || random.below(2) == 0) continue;
      const double axis = 0.5 * pi * static_cast<double>(random.below(4));
      const double aside =
          random.uniform(-1.0, 1.0) * std::pow(10.0, -1.0 - random.uniform(0.0, 6.0));
      command = static_cast<float>(std::remainder(axis + aside, 2.0 * pi));
    }
    const VehicleContract contract = some_contract(random, plan.vehicle);
    const PlanFlow held(plan);
    const Parts parts(held.flow(), contract, 1);
    for (std::size_t part = 0; part < parts.size(); ++part) {
      const PartPlace place = parts.place(part);
      if (parts.kind(place) != PartKind::ordinary) continue;
      for (int side = 0; side < 4; ++side) {
        if (!parts.arc(place).meets({0.5 * pi * (side - 1), pi})) continue;
        const double lo = 0.25 * static_cast<double>(random.below(4));
        const BehaviourImage image =
            image_of_crossing(parts, place, static_cast<PartSide>(side), lo, lo + 0.25);
        EXPECT_TRUE(image.gave_up || image.ends != 0 || !image.crossings.empty())
            << "round " << round << ", part " << place.ix << ", " << place.iy << ", side " << side;
        ++flown;
      }
    }
  }
  EXPECT_GT(flown, 5000);
}

TEST(InclusionProver, MoreLevelsKeepWhatIsProved) {
  Random random(6);
  for (int round = 0; round < 6; ++round) {
    const Plan plan = plan_to_a_goal(random);
    const VehicleContract contract = some_contract(random, plan.vehicle);
    const PlanFlow held(plan);
    const Flow flow = held.flow();
    InclusionLimits few;
    few.last_level = 2;
    const Proof coarse(flow, contract, 1, few);
    const Proof fine(flow, contract, 1);
    for (int k = 0; k < 300; ++k) {
      const Vec2 p{random.uniform(0.0, 16.0), random.uniform(0.0, 14.0)};
      const double heading = random.uniform(-pi, pi);
      const Verdict before = coarse.at(p, heading).verdict;
      if (before == Verdict::undecided) continue;
      EXPECT_EQ(fine.at(p, heading).verdict, before);
    }
  }
}

TEST(InclusionProver, ATighterContractProvesNoLess) {
  Random random(7);
  int proved_wide = 0;
  for (int round = 0; round < 20; ++round) {
    const Plan plan = plan_to_a_goal(random);
    const VehicleContract wide = some_contract(random, plan.vehicle);
    VehicleContract tight = wide;
    const double by = random.uniform(0.3, 0.9);
    tight.command_error_m *= by;
    tight.heading_error_rad *= by;
    tight.side_uncertain_rad *= by;
    const double r = plan.vehicle.turn_radius_m;
    tight.turn_radius_m = {r - by * (r - wide.turn_radius_m.least),
                           r + by * (wide.turn_radius_m.most - r)};
    ASSERT_TRUE(is_within(tight, wide));
    const PlanFlow held(plan);
    const Flow flow = held.flow();
    const Proof of_wide(flow, wide, 1);
    const Proof of_tight(flow, tight, 1);
    int wide_count = 0;
    int tight_count = 0;
    for (int k = 0; k < 400; ++k) {
      const Vec2 p{random.uniform(0.0, 16.0), random.uniform(0.0, 14.0)};
      const double heading = random.uniform(-pi, pi);
      const Verdict with_wide = of_wide.at(p, heading).verdict;
      const Verdict with_tight = of_tight.at(p, heading).verdict;
      wide_count += with_wide != Verdict::undecided ? 1 : 0;
      tight_count += with_tight != Verdict::undecided ? 1 : 0;
      if (with_wide != Verdict::undecided && with_tight != Verdict::undecided) {
        EXPECT_EQ(with_wide, with_tight);
      }
    }
    proved_wide += wide_count;
    EXPECT_GE(tight_count, wide_count) << "round " << round;
  }
  EXPECT_GT(proved_wide, 1000);
}

TEST(InclusionProver, AnImageWithoutAnEndIsTrapped) {
  // A whirl in open water, far from its borders: commands turn left of the way to the middle.
  Plan plan = empty_plan(30, 30, 1.0, 2.0);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Vec2 from = plan.grid.center(plan.grid.cell_at(i)) - Vec2{15.0, 15.0};
    const double inwards = norm(from) > 9.0 ? 1.0 : norm(from) < 6.0 ? -1.0 : 0.0;
    const double out = std::atan2(from.y, from.x);
    plan.heading_rad[i] =
        static_cast<float>(std::remainder(out + 0.5 * pi + 0.5 * inwards, 2.0 * pi));
  }
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  contract.heading_error_rad = 0.02;
  const PlanFlow held(plan);
  const Proof proof(held.flow(), contract, 1);
  EXPECT_EQ(proof.at({22.5, 15.1}, 0.5 * pi).verdict, Verdict::trapped);
}

}  // namespace
}  // namespace fairway
