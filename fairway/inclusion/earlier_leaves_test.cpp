// Continuing from earlier leaves loses nothing and believes nothing.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"
#include "fairway/inclusion/inclusion_prover.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

struct Case {
  explicit Case(std::uint64_t seed) : plan(random_plan(seed)), held(plan) {
    Random random(seed);
    contract = VehicleContract::of(plan.vehicle);
    contract.command_error_m = random.uniform(0.0, 0.5) * plan.grid.cell_m;
    contract.heading_error_rad = random.uniform(0.0, 0.05);
  }
  Parts parts() const { return {held.flow(), contract, 1}; }

  Plan plan;
  PlanFlow held;
  VehicleContract contract;
};

/// A proof of so many rounds.
ContractVerdicts proved(const Parts& parts, const ContractVerdicts* earlier, int most_rounds) {
  int rounds = 0;
  InclusionLimits limits;
  limits.go_on = [&] { return rounds < most_rounds; };
  InclusionProver prover(parts, limits);
  if (earlier != nullptr) prover.start_from(*earlier);
  prover.run([&](const InclusionLevel&) { ++rounds; });
  return prover.verdicts(1.0);
}

/// The verdict of a place on a section.
Verdict verdict_at(const ContractVerdicts& v, std::size_t section, std::uint32_t place) {
  const auto first = v.begin.begin() + v.first[section];
  const auto last = v.begin.begin() + v.first[section + 1];
  const auto next = std::upper_bound(first, last, place);
  return static_cast<Verdict>(v.verdict[static_cast<std::size_t>(next - v.begin.begin()) - 1]);
}

/// How many decided leaves of `a`, at their beginnings and ends, are otherwise in `b`.
std::size_t lost(const ContractVerdicts& a, const ContractVerdicts& b) {
  std::size_t count = 0;
  for (std::size_t s = 0; s + 1 < a.first.size(); ++s) {
    for (std::size_t k = a.first[s]; k < a.first[s + 1]; ++k) {
      if (a.verdict[k] == 0) continue;
      const std::uint32_t end = k + 1 < a.first[s + 1] ? a.begin[k + 1] : 0U;
      for (const std::uint32_t place : {a.begin[k], end - 1U}) {
        count += verdict_at(b, s, place) == static_cast<Verdict>(a.verdict[k]) ? 0 : 1;
      }
    }
  }
  return count;
}

std::size_t decided(const ContractVerdicts& v) {
  return v.leaves() - static_cast<std::size_t>(std::count(v.verdict.begin(), v.verdict.end(), 0));
}

constexpr int ever = std::numeric_limits<int>::max();

TEST(EarlierLeaves, AreAllProvedAgainWhereverTheWorkWasInterrupted) {
  std::size_t more = 0;
  for (std::uint64_t seed = 1; seed < 7; ++seed) {
    const Case c(seed);
    const Parts parts = c.parts();
    for (const int rounds : {1, 3, 6, ever}) {
      const ContractVerdicts earlier = proved(parts, nullptr, rounds);
      EXPECT_EQ(lost(earlier, proved(parts, &earlier, 1)), 0U) << seed << ", " << rounds;
      const ContractVerdicts on = proved(parts, &earlier, ever);
      EXPECT_EQ(lost(earlier, on), 0U) << seed << ", " << rounds;
      more += decided(on) > decided(earlier) ? 1 : 0;
    }
  }
  EXPECT_GT(more, 6U);
}

TEST(EarlierLeaves, HaveNoVerdictThatIsBelieved) {
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    const Case c(seed);
    const Parts parts = c.parts();
    const ContractVerdicts honest = proved(parts, nullptr, ever);
    ContractVerdicts forged = honest;
    Random random(seed);
    for (auto& verdict : forged.verdict) {
      verdict = static_cast<std::uint8_t>(random.below(verdict_count));
    }
    const ContractVerdicts a = proved(parts, &honest, ever);
    const ContractVerdicts b = proved(parts, &forged, ever);
    EXPECT_EQ(a.begin, b.begin);
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.group_time_s, b.group_time_s);
  }
}

TEST(EarlierLeaves, OfAnyPlacesContradictNothing) {
  const Case c(3);
  const Parts parts = c.parts();
  const ContractVerdicts plain = proved(parts, nullptr, ever);
  Random random(11);
  ContractVerdicts odd;  // cuts at any unit of a side / 2^32
  odd.first.push_back(0);
  for (std::size_t s = 0; s + 1 < plain.first.size(); ++s) {
    if (plain.first[s] != plain.first[s + 1]) {
      odd.begin.push_back(0);
      for (int k = 0; k < 3; ++k) odd.begin.push_back(static_cast<std::uint32_t>(random.bits()));
      std::sort(odd.begin.begin() + odd.first.back(), odd.begin.end());
    }
    odd.first.push_back(static_cast<std::uint32_t>(odd.begin.size()));
  }
  odd.verdict.assign(odd.begin.size(), 1);
  const ContractVerdicts on = proved(parts, &odd, ever);
  for (std::size_t s = 0; s + 1 < on.first.size(); ++s) {
    for (std::size_t k = on.first[s]; k < on.first[s + 1]; ++k) {
      const Verdict there = verdict_at(plain, s, on.begin[k]);
      if (on.verdict[k] == 0 || there == Verdict::undecided) continue;
      EXPECT_EQ(static_cast<Verdict>(on.verdict[k]), there);
    }
  }
  EXPECT_GT(decided(on), 0U);
}

TEST(InclusionProver, ClaimsNothingOfWhatThereWasNoTimeFor) {
  const Case c(2);
  const Parts parts = c.parts();
  const ContractVerdicts none = proved(parts, nullptr, 0);
  EXPECT_EQ(decided(none), 0U);
  EXPECT_GT(none.leaves(), 0U);
}

}  // namespace
}  // namespace fairway
