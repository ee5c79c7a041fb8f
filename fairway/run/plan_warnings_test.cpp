#include "fairway/run/plan_warnings.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace fairway {
namespace {

/// A row of `free` free cells, of which the last `cut_off` have no way to the goal, and the goal.
Plan row_of_cells(std::size_t free, std::size_t cut_off) {
  Plan plan;
  plan.grid = {static_cast<int>(free) + 1, 1, 0.0, 0.0, 1.0};
  plan.region.assign(free + 1, Region::free);
  plan.region.back() = Region::goal;
  plan.cost_m.assign(free + 1, 1.0F);
  plan.heading_rad.assign(free + 1, 0.0F);
  for (std::size_t i = free - cut_off; i < free; ++i) {
    plan.cost_m[i] = std::numeric_limits<float>::infinity();
    plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return plan;
}

TEST(CutOffWarning, ComesAboveATenthOfTheFreeCells) {
  EXPECT_FALSE(cut_off_warning(row_of_cells(1000, 0)));
  EXPECT_FALSE(cut_off_warning(row_of_cells(1000, 100)));
  EXPECT_TRUE(cut_off_warning(row_of_cells(1000, 101)));
}

TEST(CutOffWarning, HasTheShareAndTheCount) {
  const auto warning = cut_off_warning(row_of_cells(1083, 1050));
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->find("97.0 % of the free cells (1,050 of 1,083) are cut off from the goal"),
            std::string::npos)
      << *warning;
}

TEST(CutOffWarning, EndsWithTheRemedy) {
  const auto warning = cut_off_warning(row_of_cells(10, 5), "Widen the gate.");
  ASSERT_TRUE(warning);
  EXPECT_TRUE(warning->ends_with("straight on. Widen the gate.")) << *warning;
}

TEST(CutOffWarning, NamesThePathThatIsNotReached) {
  Plan plan = row_of_cells(10, 5);
  plan.record.mission = PathMission{};
  EXPECT_NE(cut_off_warning(plan)->find("cut off from the path"), std::string::npos);
}

TEST(PlanWarnings, AreThoseOfTheMapAndThenThoseOfThePlan) {
  Plan plan = row_of_cells(10, 5);
  plan.record.mission = GoalMission{};
  ObstacleMap map;
  map.grid = plan.grid;
  map.obstacle.assign(plan.grid.size(), 0);
  map.warnings = {"The map is odd."};
  EXPECT_EQ(plan_warnings({}, map, row_of_cells(10, 0)), map.warnings);
  const auto warnings = plan_warnings({}, map, plan);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_EQ(warnings[0], map.warnings[0]);
}

}  // namespace
}  // namespace fairway
