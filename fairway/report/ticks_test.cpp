#include "fairway/report/ticks.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

RC_GTEST_PROP(Ticks, AreRoundNumbersWithinTheRangeAndAboutAsManyAsWanted, (std::uint64_t seed)) {
  Random random(seed);
  const double range = std::pow(10.0, random.uniform(-6.0, 9.0));
  const double low = random.uniform(-3.0, 3.0) * range;
  const int wanted = 1 + static_cast<int>(random.below(12));
  const Ticks ticks = ticks_between(low, low + range, wanted);
  RC_ASSERT(static_cast<double>(ticks.values.size()) >= wanted - 1.0);
  RC_ASSERT(static_cast<double>(ticks.values.size()) <= 2.5 * wanted + 2.0);
  const double digit = ticks.step / std::pow(10.0, std::floor(std::log10(ticks.step) + 1e-9));
  RC_ASSERT(std::abs(digit - 1.0) < 1e-6 || std::abs(digit - 2.0) < 1e-6 ||
            std::abs(digit - 5.0) < 1e-6);
  for (const double value : ticks.values) {
    RC_ASSERT(value >= low && value <= low + range);
    RC_ASSERT(std::abs(std::remainder(value, ticks.step)) < 1e-6 * ticks.step + 1e-8 * range);
  }
}

TEST(Ticks, AnEmptyRangeHasAtMostOneTick) {
  EXPECT_EQ(ticks_between(0.0, 0.0, 5).values.size(), 1U);
  EXPECT_EQ(ticks_between(7.5e6, 7.5e6 + 1e-4, 5).values.size(), 1U);
}

TEST(Ticks, AReversedOrInfiniteRangeIsAMistake) {
  EXPECT_THROW(static_cast<void>(ticks_between(1.0, 0.0, 5)), PreconditionViolation);
  EXPECT_THROW(static_cast<void>(ticks_between(0.0, INFINITY, 5)), PreconditionViolation);
}

TEST(Ticks, LabelsHaveTheDecimalsTheStepNeedsAndNoMinusZero) {
  EXPECT_EQ(tick_label(0.30000000000000004, 0.1), "0.3");
  EXPECT_EQ(tick_label(200.0, 100.0), "200");
  EXPECT_EQ(tick_label(-0.0, 0.5), "0.0");
  EXPECT_EQ(tick_label(-0.02, 0.02), "-0.02");
  EXPECT_EQ(tick_label(1234567.0, 1.0), "1234567");
  EXPECT_EQ(tick_label(2e300, 1e300), "2e+300");
  EXPECT_EQ(tick_label(3e-9, 1e-9), "3e-09");
}

TEST(Ticks, TheRoundLengthBelowIsTheLargestThatFits) {
  EXPECT_DOUBLE_EQ(round_length_below(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_length_below(999.0), 500.0);
  EXPECT_DOUBLE_EQ(round_length_below(0.049), 0.02);
}

}  // namespace
}  // namespace fairway
