#include "fairway/run/summary.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

TEST(WilsonInterval, AgreesWithThePublishedExample) {
  // Newcombe 1998, Table I, method 3: 81 of 263 gives 0.2553 to 0.3662; 0 of 20 gives 0 to 0.1611.
  const auto [low, high] = wilson_interval(81, 263);
  EXPECT_NEAR(low, 0.2553, 5e-5);
  EXPECT_NEAR(high, 0.3662, 5e-5);
  EXPECT_EQ(wilson_interval(0, 20)[0], 0.0);
  EXPECT_NEAR(wilson_interval(0, 20)[1], 0.1611, 5e-5);
}

TEST(WilsonInterval, StaysInZeroToOneAndHoldsTheShare) {
  for (const std::size_t n : {1U, 2U, 7U, 10000U}) {
    for (const std::size_t hits : {std::size_t{0}, n / 2, n - 1, n}) {
      const auto [low, high] = wilson_interval(hits, n);
      const double share = static_cast<double>(hits) / static_cast<double>(n);
      EXPECT_LE(0.0, low);
      EXPECT_LE(low, share);
      EXPECT_LE(share, high);
      EXPECT_LE(high, 1.0);
    }
  }
  EXPECT_EQ(wilson_interval(0, 0), (std::array<double, 2>{0.0, 1.0}));
}

TEST(WilsonInterval, HoldsTheTruthNineteenTimesInTwenty) {
  Random random(5);
  constexpr int trials = 2000;
  constexpr std::size_t n = 300;
  int held = 0;
  for (int t = 0; t < trials; ++t) {
    std::size_t hits = 0;
    for (std::size_t i = 0; i < n; ++i) hits += random.unit() < 0.97 ? 1 : 0;
    const auto [low, high] = wilson_interval(hits, n);
    held += low <= 0.97 && 0.97 <= high ? 1 : 0;
  }
  EXPECT_NEAR(held / static_cast<double>(trials), 0.95, 0.02);
}

OutcomeCounts counts(std::size_t reach, std::size_t collide, std::size_t leave,
                     std::size_t trapped) {
  return {{0, reach, collide, leave, trapped}};
}

TEST(OutcomeWords, NeverRoundAMissAway) {
  EXPECT_EQ(outcome_words(counts(99999, 1, 0, 0)).substr(0, 21), "99999 reach (99.99 %;");
  EXPECT_EQ(outcome_words(counts(10, 0, 0, 0)).substr(0, 19), "10 reach (100.00 %;");
}

TEST(OutcomeJson, CountsEveryOutcomeByName) {
  const auto report = outcome_json(counts(5, 3, 2, 0));
  EXPECT_EQ(report["count"], 10);
  EXPECT_EQ(report["outcomes"]["collide"], 3);
  EXPECT_EQ(report["share"]["leave"], 0.2);
  EXPECT_EQ(report["share"]["trapped"], 0.0);
  EXPECT_TRUE(outcome_json(counts(0, 0, 0, 0))["share"]["reach"].is_null());
}

TEST(RegionCells, CountEveryCellOnce) {
  Plan plan;
  plan.grid = {3, 2, 0, 0, 1};
  constexpr float infinite = std::numeric_limits<float>::infinity();
  plan.region = {Region::free,     Region::free,   Region::goal,
                 Region::obstacle, Region::buffer, Region::obstacle};
  plan.cost_m = {1.0F, infinite, 0.0F, infinite, infinite, infinite};
  plan.heading_rad.assign(6, 0.0F);
  const RegionCells cells = count_regions(plan);
  EXPECT_EQ(cells.free, 2U);
  EXPECT_EQ(cells.buffer, 1U);
  EXPECT_EQ(cells.obstacle, 2U);
  EXPECT_EQ(cells.goal, 1U);
  EXPECT_EQ(cells.unreachable, 1U);
}

}  // namespace
}  // namespace fairway
