#include "fairway/run/estimate_of_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/run/stratified_states.hpp"

namespace fairway {
namespace {

TEST(EstimateOfPairs, IsARatioWithAnErrorFromThePairsAlone) {
  const std::vector<double> part{1.0, 0.0, 1.0, 1.0};
  const std::vector<double> ones(4, 1.0);
  const SampledValue share = ratio_of_totals(part, ones);
  EXPECT_DOUBLE_EQ(share.value, 0.75);
  EXPECT_DOUBLE_EQ(share.standard_error, 0.25);  // only the first pair differs, by 1 of 4
  EXPECT_EQ(share.states, 4U);
  // What does not count leaves the others' ratio as it is.
  const std::vector<double> some{2.0, 2.0, 0.0, 4.0};
  const SampledValue rate = ratio_of_totals(std::vector<double>{1.0, 3.0, 0.0, 4.0}, some);
  EXPECT_DOUBLE_EQ(rate.value, 1.0);
  EXPECT_EQ(rate.states, 3U);
  EXPECT_DOUBLE_EQ(rate.standard_error, 2.0 / 8.0);  // residuals -1, 1 of a pair; 0, 0
  const SampledValue none = ratio_of_totals(part, std::vector<double>(4, 0.0));
  EXPECT_TRUE(std::isnan(none.value));
  EXPECT_EQ(none.states, 0U);
  EXPECT_THROW((void)ratio_of_totals(std::vector<double>(3), std::vector<double>(3)),
               PreconditionViolation);
}

TEST(EstimateOfPairs, OfADifferenceKnowsWhatBothHaveInCommon) {
  const std::vector<double> ones(6, 1.0);
  const std::vector<double> first{1.0, 5.0, 2.0, 9.0, 4.0, 4.5};
  std::vector<double> second = first;
  EXPECT_EQ(difference_of_ratios(first, ones, second, ones).value, 0.0);
  EXPECT_EQ(difference_of_ratios(first, ones, second, ones).standard_error, 0.0);
  for (double& value : second) value += 2.0;
  const SampledValue shifted = difference_of_ratios(first, ones, second, ones);
  EXPECT_NEAR(shifted.value, 2.0, 1e-14);
  EXPECT_NEAR(shifted.standard_error, 0.0, 1e-14);
  EXPECT_NEAR(difference_of_ratios(second, ones, first, ones).value, -2.0, 1e-14);
}

TEST(EstimateOfPairs, QuantilesAreValuesOfTheSampleWithinTheirIntervals) {
  std::vector<double> values;
  for (int i = 1; i <= 100; ++i) values.push_back(i);
  const QuantileEstimate p05 = quantile_of(values, 0.05);
  EXPECT_EQ(p05.value, 5.0);
  EXPECT_EQ(p05.low, 1.0);    // 5 - 1.96 sqrt(100 * 0.05 * 0.95) = 0.7
  EXPECT_EQ(p05.high, 10.0);  // and 9.3
  EXPECT_EQ(quantile_of(values, 0.5).value, 50.0);
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(quantile_of({infinite, 3.0, infinite}, 0.5).value, infinite);
  EXPECT_TRUE(std::isnan(quantile_of({}, 0.5).value));
}

/// Of states of a grid with a hole: some property of the place and heading, true mean known.
TEST(EstimateOfPairs, ItsIntervalsHoldTheTruthNineteenTimesOfTwenty) {
  const Grid grid{20, 10, -3.0, 2.0, 0.5};
  std::vector<bool> ground(grid.size(), true);
  for (int iy = 3; iy < 7; ++iy) ground[grid.index({12, iy})] = false;
  const auto has = [](const State& s) {
    return s.position_m.x + 0.4 * std::sin(s.heading.rad()) > 0.7 ? 1.0 : 0.0;
  };
  const auto weight = [](const State& s) { return 1.0 + s.position_m.y * s.position_m.y; };
  const auto measured = [&](std::size_t strata, std::uint64_t seed) {
    const std::vector<State> states = stratified_states(grid, ground, strata, seed);
    std::vector<double> part;
    std::vector<double> whole;
    for (const State& s : states) {
      whole.push_back(weight(s));
      part.push_back(weight(s) * has(s));
    }
    return ratio_of_totals(part, whole);
  };
  const SampledValue truth = measured(400'000, 77);
  int held = 0;
  double squares = 0.0;
  double variances = 0.0;
  constexpr int draws = 600;
  for (int draw = 0; draw < draws; ++draw) {
    const SampledValue e = measured(200, static_cast<std::uint64_t>(draw));
    const double off = e.value - truth.value;
    held += std::abs(off) <= 1.96 * e.standard_error ? 1 : 0;
    squares += off * off;
    variances += e.standard_error * e.standard_error;
  }
  EXPECT_GE(held, 540);  // 95 % of 600 is 570, with a standard deviation of 5
  EXPECT_LE(held, 595);
  EXPECT_NEAR(variances / squares, 1.0, 0.25);
  EXPECT_LT(truth.standard_error, 0.05 * std::sqrt(squares / draws));
}

TEST(StratifiedStates, AreEvenOverTheGroundAndNowhereElse) {
  const Grid grid{9, 7, 10.0, -5.0, 2.0};
  std::vector<bool> ground(grid.size(), true);
  for (std::size_t i = 0; i < grid.size(); i += 3) ground[i] = false;  // 42 cells are left
  const std::vector<State> states = stratified_states(grid, ground, 420, 5);
  ASSERT_EQ(states.size(), 840U);
  std::vector<int> count(grid.size(), 0);
  for (const State& s : states) ++count[grid.index(grid.cell_of(s.position_m))];
  for (std::size_t i = 0; i < grid.size(); ++i) EXPECT_EQ(count[i], ground[i] ? 20 : 0);
  EXPECT_EQ(states, stratified_states(grid, ground, 420, 5));
  EXPECT_NE(states, stratified_states(grid, ground, 420, 6));
  EXPECT_TRUE(stratified_states(grid, std::vector<bool>(grid.size()), 10, 1).empty());
}

TEST(StratifiedStates, MayBeFewerThanTheCells) {
  const Grid grid{30, 30, 0.0, 0.0, 1.0};
  const std::vector<State> states =
      stratified_states(grid, std::vector<bool>(grid.size(), true), 9, 1);
  ASSERT_EQ(states.size(), 18U);
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    for (const State& s : stratified_states(grid, std::vector<bool>(grid.size(), true), 9, seed)) {
      sum += s.position_m.x;
    }
  }
  EXPECT_NEAR(sum / 9000.0, 15.0, 0.15);
}

}  // namespace
}  // namespace fairway
