// The time left of a proof, by series whose end is known.
#include "fairway/run/time_left.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

/// Levels of which each takes `growth` times as long and leaves `kept` of what was undecided.
struct Series {
  double first_s = 1.0;
  double growth = 1.5;
  double kept = 0.6;
  double at_s(int level) const {
    double sum = 0.0;
    for (int i = 0; i <= level; ++i) sum += first_s * std::pow(growth, i);
    return sum;
  }
  double share(int level) const { return 0.8 * std::pow(kept, level); }
};

UndecidedTrend after(const Series& series, int levels, double undecided_max) {
  UndecidedTrend trend(undecided_max);
  for (int i = 0; i < levels; ++i) trend.add(series.at_s(i), series.share(i));
  return trend;
}

TEST(TimeLeft, OfEvenLevelsTheEndIsThatOfTheLevelThatMeetsTheGoal) {
  for (const double growth : {1.2, 1.5, 1.8}) {
    for (const double kept : {0.2, 0.5, 0.9}) {
      const Series series{.first_s = 0.5, .growth = growth, .kept = kept};
      int told = 0;
      for (int levels = 3; levels <= 10; ++levels) {
        const auto end_s = after(series, levels, series.share(10)).end_s();
        if (!end_s) {
          EXPECT_GT(series.at_s(11), 10.0 * series.at_s(levels - 1)) << "near enough to tell";
          continue;
        }
        EXPECT_GE(*end_s, series.at_s(10) * (1.0 - 1e-9)) << growth << " " << kept << " " << levels;
        EXPECT_LE(*end_s, series.at_s(11)) << growth << " " << kept << " " << levels;
        ++told;
      }
      EXPECT_GE(told, 3);
    }
  }
}

TEST(TimeLeft, OneOddLevelDoesNotRunAwayWithIt) {
  const Series series{.first_s = 1.0, .growth = 1.4, .kept = 0.55};
  for (const double odd : {0.3, 0.7, 1.5}) {
    UndecidedTrend trend(series.share(12));
    double late_s = 0.0;
    for (int i = 0; i < 8; ++i) {
      if (i == 6) late_s = (odd - 1.0) * (series.at_s(6) - series.at_s(5));
      trend.add(series.at_s(i) + late_s, series.share(i));
    }
    const auto end_s = trend.end_s();
    ASSERT_TRUE(end_s) << odd;
    EXPECT_GT(*end_s, 0.4 * series.at_s(12)) << odd;
    EXPECT_LT(*end_s, 2.5 * series.at_s(12)) << odd;
  }
}

TEST(TimeLeft, ClocksThatRunFasterEndSoonerAlike) {
  const auto slow = after({.first_s = 1.0}, 6, 0.01).end_s();
  const auto fast = after({.first_s = 0.125}, 6, 0.01).end_s();
  ASSERT_TRUE(slow && fast);
  EXPECT_NEAR(*fast, 0.125 * *slow, 1e-9);
}

TEST(TimeLeft, NothingIsSaidOfWhatCannotBeTold) {
  EXPECT_FALSE(UndecidedTrend(0.01).end_s());
  EXPECT_FALSE(after({}, 2, 0.01).end_s());
  EXPECT_FALSE(after({}, 8, 0.0).end_s()) << "no share is below nothing";
  EXPECT_FALSE(after({.kept = 0.999}, 8, 0.01).end_s()) << "a stalled proof";
  EXPECT_FALSE(after({.kept = 1.0}, 8, 0.01).end_s());
  EXPECT_FALSE(after({.growth = 2.0, .kept = 0.9}, 8, 1e-6).end_s()) << "hours away";
  UndecidedTrend odd(0.01);
  for (int i = 0; i < 4; ++i) odd.add(0.0, 0.5);
  odd.add(1.0, 0.0);
  EXPECT_FALSE(odd.end_s());
}

TEST(TimeLeft, TheEndIsNeverBeforeTheLastLevelWhateverTheSeries) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Random random = Random::stream(seed, 1);
    UndecidedTrend trend(0.001 + 0.1 * random.unit());
    double at_s = 0.0;
    double share = 1.0;
    for (int level = 0; level < 12; ++level) {
      at_s += random.unit() + 1e-6;
      share *= random.below(4) == 0 ? 1.0 : random.unit();
      trend.add(at_s, share);
      if (const auto end_s = trend.end_s()) {
        ASSERT_TRUE(std::isfinite(*end_s));
        ASSERT_GE(*end_s, at_s * (1.0 - 1e-12));
      }
    }
  }
}

TEST(TimeLeft, WordsSayWhatEndsTheWorkFirst) {
  EXPECT_EQ(time_left_words({}, 5.0), "");
  EXPECT_EQ(time_left_words({40.0, unknown_time}, 0.0), ", about 40 s left");
  EXPECT_EQ(time_left_words({40.0, unknown_time}, 10.5), ", about 30 s left");
  EXPECT_EQ(time_left_words({40.0, 100.0}, 0.0), ", about 40 s left");
  EXPECT_EQ(time_left_words({40.0, 12.0}, 0.0), ", time limit in 12 s");
  EXPECT_EQ(time_left_words({unknown_time, 125.0}, 0.0), ", time limit in 2 min 05 s");
  EXPECT_EQ(time_left_words({unknown_time, 5.0}, 6.0), ", time limit reached");
  EXPECT_EQ(time_left_words({0.5, unknown_time}, 0.0), ", almost done");
}

TEST(TimeLeft, AnEstimateThatWasWrongIsNotInsistedOn) {
  EXPECT_EQ(time_left_words({10.0, unknown_time}, 60.0), "");
  EXPECT_EQ(time_left_words({10.0, 100.0}, 60.0), ", time limit in 40 s");
}

TEST(TimeLeft, DurationsAreWholeSecondsUpwards) {
  EXPECT_EQ(duration_text(-1.0), "0 s");
  EXPECT_EQ(duration_text(0.2), "1 s");
  EXPECT_EQ(duration_text(59.2), "1 min 00 s");
  EXPECT_EQ(duration_text(3600.0), "60 min 00 s");
}

TEST(TimeLeft, LinesForALogComeAtGrowingIntervals) {
  std::vector<double> lines;
  for (double at_s = 0.0; lines.size() < 10; at_s = lines.back())
    lines.push_back(next_line_s(at_s));
  EXPECT_EQ(lines, (std::vector<double>{10, 20, 40, 80, 160, 320, 640, 1240, 1840, 2440}));
  EXPECT_EQ(next_line_s(100.0), 160.0);
}

}  // namespace
}  // namespace fairway
