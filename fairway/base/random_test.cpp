#include "fairway/base/random.hpp"

#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace fairway {
namespace {

TEST(RandomDraws, SeedingFollowsThePublishedSplitmix64) {
  // First outputs of splitmix64 from state 1234567, as published with the generator.
  std::uint64_t state = 1234567;
  EXPECT_EQ(splitmix64(state), 6457827717110365317ULL);
  EXPECT_EQ(splitmix64(state), 3203168211198807973ULL);
  EXPECT_EQ(splitmix64(state), 9817491932198370423ULL);
}

TEST(RandomDraws, SameSeedSameDraws) {
  Random a(5), b(5), c(6);
  int differing = 0;
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t x = a.bits();
    EXPECT_EQ(x, b.bits());
    differing += x != c.bits();
  }
  EXPECT_GT(differing, 95);
}

TEST(RandomDraws, StreamsOfNeighbouringItemsAndSeedsDiffer) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    for (std::uint64_t item = 0; item < 50; ++item) first.insert(Random::stream(seed, item).bits());
  }
  EXPECT_EQ(first.size(), 2500U);
}

TEST(RandomDraws, BelowIsUniform) {
  Random random(3);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70000; ++i) ++counts[random.below(7)];
  double chi2 = 0.0;
  for (const int n : counts) chi2 += (n - 10000.0) * (n - 10000.0) / 10000.0;
  EXPECT_LT(chi2, 22.5);  // 6 degrees of freedom, one in a thousand
  EXPECT_EQ(random.below(1), 0U);
}

TEST(RandomDraws, UnitAndNormalHaveTheirMoments) {
  Random random(4);
  constexpr int n = 200000;
  double unit = 0.0, mean = 0.0, square = 0.0, fourth = 0.0;
  for (int i = 0; i < n; ++i) {
    const double u = random.unit();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    unit += u;
    const double z = random.normal();
    mean += z;
    square += z * z;
    fourth += z * z * z * z;
  }
  EXPECT_NEAR(unit / n, 0.5, 4 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(mean / n, 0.0, 4 / std::sqrt(n));
  EXPECT_NEAR(square / n, 1.0, 4 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth / n, 3.0, 4 * std::sqrt(96.0 / n));
}

}  // namespace
}  // namespace fairway
