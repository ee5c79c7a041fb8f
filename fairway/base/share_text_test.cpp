#include "fairway/base/share_text.hpp"

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

TEST(Grouped, HasACommaForEveryThousand) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
  EXPECT_EQ(plural(1, "cell"), "1 cell");
  EXPECT_EQ(plural(2000, "cell"), "2,000 cells");
}

TEST(PercentText, NeverReadsAsAllOrNothingWhatIsNot) {
  EXPECT_EQ(percent_text(0.0), "0 %");
  EXPECT_EQ(percent_text(1.0), "100 %");
  EXPECT_EQ(percent_text(1e-9), "< 0.1 %");
  EXPECT_EQ(percent_text(1.0 - 1e-9), "> 99.9 %");
  EXPECT_EQ(percent_text(0.9696), "97.0 %");
  EXPECT_EQ(percent_text(0.004, 0), "< 1 %");
  EXPECT_EQ(percent_text(0.994, 0), "99 %");
  EXPECT_EQ(percent_text(0.996, 0), "> 99 %");
  EXPECT_EQ(percent_text(std::size_t{1050}, std::size_t{1083}), "97.0 %");
  EXPECT_EQ(percent_text(std::size_t{0}, std::size_t{0}), "0 %");
}

TEST(DecimalsOfSample, GoDownWithTheSample) {
  EXPECT_EQ(decimals_of_sample(0), 0);
  EXPECT_EQ(decimals_of_sample(1000), 0);       // 3 %
  EXPECT_EQ(decimals_of_sample(10'000), 0);     // 1 %
  EXPECT_EQ(decimals_of_sample(1'000'000), 1);  // 0.1 %
  EXPECT_EQ(decimals_of_sample(1'000'000'000), 1);
}

std::string text_of(std::size_t hits, std::size_t count) {
  const SampledShare text = sampled_share(hits, count);
  return text.share + ", " + text.interval;
}

TEST(SampledShare, ShowsNoMoreDigitsThanTheIntervalBears) {
  EXPECT_EQ(text_of(9934, 10'000), "99.3 %, 99.1 % to 99.5 %");
  EXPECT_EQ(text_of(1, 2), "50 %, 9 % to 91 %");
  EXPECT_EQ(text_of(10'000, 10'000), "100 %, 99.96 % to 100 %");
  EXPECT_EQ(text_of(0, 10'000), "0 %, 0 % to 0.04 %");
}

TEST(SampledShare, NeverRoundsAMissAway) {
  EXPECT_EQ(text_of(9999, 10'000), "99.99 %, 99.94 % to > 99.99 %");
  EXPECT_EQ(text_of(99'999, 100'000), "99.999 %, 99.994 % to > 99.999 %");
}

}  // namespace
}  // namespace fairway
