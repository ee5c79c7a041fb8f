#include "fairway/run/summary.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace fairway {
namespace {

OutcomeCounts counts(std::size_t reach, std::size_t collide, std::size_t leave,
                     std::size_t trapped) {
  return {{0, reach, collide, leave, trapped}};
}

TEST(OutcomeWords, NeverRoundAMissAway) {
  EXPECT_EQ(outcome_words(counts(99999, 1, 0, 0)),
            "99,999 reach (99.999 %; 95 % interval 99.994 % to > 99.999 %), 1 collides, 0 leave "
            "the map, 0 get trapped");
  EXPECT_EQ(outcome_words(counts(10, 0, 0, 0)).substr(0, 18), "10 reach (100 %; 9");
}

TEST(FailureWords, CountWhatDoesNotReach) {
  EXPECT_EQ(failure_words(counts(5, 0, 0, 0)), "");
  EXPECT_EQ(failure_words(counts(5, 1, 0, 1200)), "1 collides, 1,200 get trapped");
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
