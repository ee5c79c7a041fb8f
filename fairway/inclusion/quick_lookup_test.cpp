// Quick answers are those of contract_answer, but for a few, and hold for every behaviour flown.
#include "fairway/inclusion/quick_lookup.hpp"

#include <array>
#include <cmath>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"
#include "fairway/inclusion/inclusion_prover.hpp"
#include "fairway/inclusion/testing/behaviour.hpp"
#include "fairway/vehicle/filled_commands.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

struct Case {
  explicit Case(std::uint64_t seed, int most_per_cell = 3)
      : plan(random_plan(seed)),
        held(plan),
        contract(drawn(plan, seed)),
        parts(held.flow(), contract, 1 + static_cast<int>(seed % most_per_cell)) {
    InclusionProver prover(parts, {});
    prover.run([](const InclusionLevel&) {});
    verdicts = prover.verdicts(1.0);
  }
  static VehicleContract drawn(const Plan& plan, std::uint64_t seed) {
    Random random(seed);
    VehicleContract made = VehicleContract::of(plan.vehicle);
    made.speed_mps = {1.0, 1.0};
    made.command_error_m = random.uniform(0.0, 0.4) * plan.grid.cell_m;
    made.heading_error_rad = random.uniform(0.0, 0.05);
    made.turn_radius_m.most *= seed % 4 == 0 ? 1.0 : 1.1;
    if (seed % 3 == 0) made.side_uncertain_rad = random.uniform(0.0, 0.5);
    return made;
  }
  ContractAnswer flown(Vec2 place, double heading_rad) const {
    return contract_answer(parts, verdicts, 1.0, place, heading_rad);
  }

  Plan plan;
  PlanFlow held;
  VehicleContract contract;
  Parts parts;
  ContractVerdicts verdicts;
};

struct Asked {
  Vec2 place;
  double heading_rad;
};

/// Some on borders of parts and boxes, and with headings between them, or along an axis.
std::vector<Asked> some_states(const Parts& parts, std::size_t count, Random& random) {
  std::vector<Asked> states(count);
  for (Asked& s : states) {
    s.place = {random.unit() * parts.nx(), random.unit() * parts.ny()};
    s.heading_rad = random.uniform(-7.0, 7.0);
    if (random.below(9) == 0) s.place.x = 0.25 * std::floor(4.0 * s.place.x);
    if (random.below(5) == 0) s.heading_rad = pi / 32.0 * static_cast<double>(random.below(128));
    if (random.below(9) == 0) s.place.x += 1e-9 * random.uniform(0.0, 1.0);
  }
  return states;
}

/// How a behaviour ends within that way, in metres; undecided, if it does not.
Verdict end_of(Behaviour behaviour, const Flow& flow, double step_m, double most_m) {
  CellKind kind = flow.kind_at(flow.grid.cell_of(behaviour.place()));
  for (double way = 0.0; kind == CellKind::ordinary && way < most_m; way += step_m) {
    behaviour.step(step_m);
    kind = flow.kind_at(flow.grid.cell_of(behaviour.place()));
  }
  return kind == CellKind::obstacle  ? Verdict::collide
         : kind == CellKind::outside ? Verdict::leave
         : kind == CellKind::target  ? Verdict::reach
                                     : Verdict::undecided;
}

TEST(QuickLookup, AnswersWhatAFlightAnswersButForAFew) {
  std::array<int, verdict_count> seen{};
  int more = 0;
  int less = 0;
  double longer = 0.0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Case c(seed);
    const QuickLookup lookup(c.parts, c.verdicts, 1.0);
    Random random(seed);
    for (const Asked& s : some_states(c.parts, 500, random)) {
      const ContractAnswer own = c.flown(s.place, s.heading_rad);
      const ContractAnswer quick = lookup.answer(s.place, s.heading_rad);
      ++seen[static_cast<std::size_t>(quick.verdict)];
      EXPECT_EQ(std::isinf(quick.worst_time_s),
                quick.verdict == Verdict::undecided || quick.verdict == Verdict::trapped);
      if (own.verdict == quick.verdict) {
        if (own.worst_time_s > 0.0 && own.verdict == Verdict::reach)
          longer += quick.worst_time_s / own.worst_time_s - 1.0;
        continue;
      }
      more += own.verdict == Verdict::undecided ? 1 : 0;
      less += quick.verdict == Verdict::undecided ? 1 : 0;
      EXPECT_TRUE(own.verdict == Verdict::undecided || quick.verdict == Verdict::undecided)
          << "seed " << seed << ": " << s.place.x << ", " << s.place.y << ", " << s.heading_rad;
    }
  }
  EXPECT_LE(less, more);
  EXPECT_LT(more, 120);
  EXPECT_LT(longer, 0.1 * seen[static_cast<std::size_t>(Verdict::reach)]);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::undecided)], 100);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::reach)], 100);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::collide)], 100);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::leave)], 100);
}

TEST(QuickLookup, EveryBehaviourDoesWhatItAnswersAndInTime) {
  std::array<int, verdict_count> ended{};
  for (std::uint64_t seed = 30; seed < 54; ++seed) {
    const Case c(seed);
    const QuickLookup lookup(c.parts, c.verdicts, 1.0);
    const Flow flow = c.held.flow();
    const std::vector<float> commands = filled_commands(flow.grid, flow.heading_rad);
    const double step_m = 0.01 * c.contract.turn_radius_m.least;
    Random random(seed);
    for (const Asked& s : some_states(c.parts, 60, random)) {
      const ContractAnswer answer = lookup.answer(s.place, s.heading_rad);
      if (answer.verdict == Verdict::undecided || answer.verdict == Verdict::trapped) continue;
      const Vec2 from = c.parts.part_m() * s.place + flow.grid.corner({0, 0});
      for (int flight = 0; flight < 4; ++flight) {
        const Behaviour behaviour(flow, commands, c.contract, from, s.heading_rad, random.bits());
        const Verdict end = end_of(behaviour, flow, step_m, answer.worst_time_s + step_m);
        ASSERT_EQ(end, answer.verdict)
            << "seed " << seed << ": " << s.place.x << ", " << s.place.y << ", " << s.heading_rad;
        ++ended[static_cast<std::size_t>(end)];
      }
    }
  }
  EXPECT_GT(ended[static_cast<std::size_t>(Verdict::reach)], 500);
  EXPECT_GT(ended[static_cast<std::size_t>(Verdict::collide)], 500);
  EXPECT_GT(ended[static_cast<std::size_t>(Verdict::leave)], 300);
}

/// Sets of states: wide ranges of headings, too, and parts of cells.
TEST(QuickLookup, ASetReachesIfAllItsBehavioursDoAndInTime) {
  int proved = 0;
  int refused = 0;
  int contradicted = 0;  // by a flight of the whole set in steps of 5 degrees
  for (std::uint64_t seed = 60; seed < 84; ++seed) {
    const Case c(seed);
    const QuickLookup lookup(c.parts, c.verdicts, 1.0);
    const Flow flow = c.held.flow();
    const std::vector<float> commands = filled_commands(flow.grid, flow.heading_rad);
    const double step_m = 0.01 * c.contract.turn_radius_m.least;
    Random random(seed);
    for (int k = 0; k < 400; ++k) {
      const PartPlace part = c.parts.place(random.below(c.parts.size()));
      if (c.parts.kind(part) != PartKind::ordinary) continue;
      const Vec2 low{part.ix + 0.9 * random.unit(), part.iy + 0.9 * random.unit()};
      const double side = random.below(4) == 0 ? 0.0 : random.uniform(0.0, 0.1);
      Vec2 corners[]{low, low + Vec2{side, 0.0}, low + Vec2{0.0, side}, low + Vec2{side, side}};
      const HeadingArc headings{random.uniform(-pi, pi),
                                random.below(4) == 0 ? 0.0 : random.uniform(0.0, 0.6)};
      const ConvexSet set = ConvexSet::hull(corners);
      const QuickLookup::SetReach found = lookup.reach(part, set, headings);
      const bool flown =
          contract_answer(c.parts, c.verdicts, 1.0, part, set, headings).verdict == Verdict::reach;
      if (found.reaches == QuickLookup::Reaches::no) {
        ++refused;
        contradicted += flown ? 1 : 0;
      }
      if (found.reaches != QuickLookup::Reaches::yes) continue;
      ++proved;
      contradicted += flown ? 0 : 1;
      for (int flight = 0; flight < 3; ++flight) {
        const Vec2 place = low + Vec2{side * random.unit(), side * random.unit()};
        const double heading_rad =
            headings.lo_rad + headings.width_rad * (flight == 0   ? 0.0
                                                    : flight == 1 ? 1.0
                                                                  : random.unit());
        const Behaviour behaviour(flow, commands, c.contract,
                                  c.parts.part_m() * place + flow.grid.corner({0, 0}), heading_rad,
                                  random.bits());
        ASSERT_EQ(end_of(behaviour, flow, step_m, found.time_s + step_m), Verdict::reach)
            << "seed " << seed << ": " << place.x << ", " << place.y << ", " << heading_rad;
      }
    }
  }
  EXPECT_GT(proved, 100);
  EXPECT_GT(refused, 300);
  EXPECT_LT(contradicted, (proved + refused) / 50);
}

TEST(QuickLookup, AsksForAFlightWhereSetsAreVeryLarge) {
  const Case c(8, 2);
  VehicleContract wide = c.contract;
  wide.turn_radius_m = {40.0 * c.parts.part_m(), 41.0 * c.parts.part_m()};
  const Parts parts(c.held.flow(), wide, 1 + 8 % 2);
  const QuickLookup lookup(parts, c.verdicts, 1.0);
  Random random(8);
  for (const Asked& s : some_states(parts, 50, random)) {
    const ContractAnswer own = contract_answer(parts, c.verdicts, 1.0, s.place, s.heading_rad);
    const ContractAnswer quick = lookup.answer(s.place, s.heading_rad);
    EXPECT_EQ(own.verdict, quick.verdict);
    EXPECT_EQ(own.worst_time_s, quick.worst_time_s);
  }
}

TEST(QuickLookup, SaysTheSameToEveryThread) {
  const Case c(5);
  Random random(5);
  const std::vector<Asked> states = some_states(c.parts, 400, random);
  const QuickLookup lookup(c.parts, c.verdicts, 1.0);
  const auto answers = [&] {
    std::vector<ContractAnswer> all;
    for (const Asked& s : states) all.push_back(lookup.answer(s.place, s.heading_rad));
    return all;
  };
  std::vector<ContractAnswer> others;
  std::thread other([&] { others = answers(); });
  const std::vector<ContractAnswer> first = answers();
  other.join();
  for (std::size_t k = 0; k < states.size(); ++k) {
    EXPECT_EQ(first[k].verdict, others[k].verdict);
    EXPECT_EQ(first[k].worst_time_s, others[k].worst_time_s);
  }
}

}  // namespace
}  // namespace fairway
