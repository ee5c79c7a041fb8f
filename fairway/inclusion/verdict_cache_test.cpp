// Cached answers are those of the states themselves, whatever was asked before.
#include "fairway/inclusion/verdict_cache.hpp"

#include <array>
#include <cmath>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"
#include "fairway/inclusion/inclusion_prover.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

struct Case {
  explicit Case(std::uint64_t seed)
      : plan(random_plan(seed)),
        held(plan),
        contract(drawn(plan, seed)),
        parts(held.flow(), contract, 1 + static_cast<int>(seed % 3)) {
    InclusionProver prover(parts, {});
    prover.run([](const InclusionLevel&) {});
    verdicts = prover.verdicts(1.0);
  }
  static VehicleContract drawn(const Plan& plan, std::uint64_t seed) {
    Random random(seed);
    VehicleContract made = VehicleContract::of(plan.vehicle);
    made.command_error_m = random.uniform(0.0, 0.4) * plan.grid.cell_m;
    made.heading_error_rad = random.uniform(0.0, 0.05);
    made.turn_radius_m.most *= 1.1;
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

/// Some on borders of parts and boxes, and with headings between them.
std::vector<Asked> some_states(const Parts& parts, std::size_t count, Random& random) {
  std::vector<Asked> states(count);
  for (Asked& s : states) {
    s.place = {random.unit() * parts.nx(), random.unit() * parts.ny()};
    s.heading_rad = random.uniform(-7.0, 7.0);
    if (random.below(5) == 0) s.place.x = 0.25 * std::floor(4.0 * s.place.x);
    if (random.below(5) == 0) s.heading_rad = pi / 32.0 * static_cast<double>(random.below(128));
    if (random.below(9) == 0) s.place.x += 1e-9 * random.uniform(0.0, 1.0);
  }
  return states;
}

TEST(VerdictCache, AnswersWhatTheStateItselfAnswers) {
  std::array<int, verdict_count> seen{};
  int more = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Case c(seed);
    const VerdictCache cache(c.parts, c.verdicts, 1.0);
    Random random(seed);
    for (const Asked& s : some_states(c.parts, 300, random)) {
      const ContractAnswer own = c.flown(s.place, s.heading_rad);
      const ContractAnswer cached = cache.answer(s.place, s.heading_rad);
      ++seen[static_cast<std::size_t>(own.verdict)];
      more += cached.verdict != own.verdict ? 1 : 0;
      if (own.verdict == Verdict::undecided) continue;  // as one of a box it may be decided
      ASSERT_EQ(cached.verdict, own.verdict)
          << "seed " << seed << ": " << s.place.x << ", " << s.place.y << ", " << s.heading_rad;
      EXPECT_GE(cached.worst_time_s, own.worst_time_s);
    }
  }
  EXPECT_LT(more, 10);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::undecided)], 100);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::reach)], 100);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::collide)], 100);
}

TEST(VerdictCache, RemembersNothingThatChangesAnAnswer) {
  const Case c(5);
  Random random(5);
  const std::vector<Asked> states = some_states(c.parts, 400, random);
  const VerdictCache cache(c.parts, c.verdicts, 1.0);
  const auto answers = [&](const VerdictCache& asked) {
    std::vector<ContractAnswer> all;
    for (const Asked& s : states) all.push_back(asked.answer(s.place, s.heading_rad));
    return all;
  };
  std::vector<ContractAnswer> others;
  std::thread other([&] { others = answers(cache); });
  const std::vector<ContractAnswer> first = answers(cache);
  other.join();
  for (const Asked& s : some_states(c.parts, 3000, random)) {
    (void)cache.answer(s.place, s.heading_rad);
  }
  const std::vector<ContractAnswer> later = answers(cache);
  for (std::size_t k = 0; k < states.size(); ++k) {
    EXPECT_EQ(first[k].verdict, later[k].verdict);
    EXPECT_EQ(first[k].worst_time_s, later[k].worst_time_s);
    EXPECT_EQ(first[k].verdict, others[k].verdict);
    EXPECT_EQ(first[k].worst_time_s, others[k].worst_time_s);
  }
}

}  // namespace
}  // namespace fairway
