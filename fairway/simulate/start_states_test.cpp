#include "fairway/simulate/start_states.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace fairway {
namespace {

Plan patchwork() {
  Plan plan;
  plan.grid = {16, 16, -3.0, 7.0, 2.0};
  plan.heading_rad.assign(plan.grid.size(), 0.0F);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    plan.region.push_back(static_cast<Region>(static_cast<int>(i % 4) - 1));
    if (i % 8 == 1) plan.cost_m[i] = std::numeric_limits<float>::infinity();
  }
  return plan;
}

TEST(StartStates, LieInTheCellsAskedFor) {
  const Plan plan = patchwork();
  for (const StartRegion where :
       {StartRegion::safe_start, StartRegion::flyable, StartRegion::not_obstacle}) {
    const std::vector<State> states = random_states(plan, where, 3000, 5);
    ASSERT_EQ(states.size(), 3000U);
    for (const State& state : states) {
      const std::size_t cell = plan.grid.index(plan.grid.cell_of(state.position_m));
      ASSERT_NE(plan.region[cell], Region::obstacle);
      if (where != StartRegion::not_obstacle) {
        ASSERT_NE(plan.region[cell], Region::goal);
      }
      if (where == StartRegion::safe_start) {
        ASSERT_EQ(plan.region[cell], Region::free);
        ASSERT_TRUE(std::isfinite(plan.cost_m[cell]));
      }
    }
  }
}

TEST(StartStates, CoverCellsAndHeadingsEvenly) {
  const std::vector<State> states = random_states(patchwork(), StartRegion::flyable, 40000, 6);
  double mean_x = 0.0;
  double cosine = 0.0;
  int left = 0;
  for (const State& state : states) {
    mean_x += (state.position_m.x + 3.0) / 40000.0;
    cosine += std::cos(state.heading.rad()) / 40000.0;
    left += state.heading.rad() > 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(mean_x, 14.0, 0.25);  // columns 0, 1 of every four: five standard deviations
  EXPECT_NEAR(cosine, 0.0, 0.02);
  EXPECT_NEAR(left, 20000, 500);
}

TEST(StartStates, BeginAlikeWhateverTheirNumber) {
  const std::vector<State> few = random_states(patchwork(), StartRegion::flyable, 10, 7);
  const std::vector<State> many = random_states(patchwork(), StartRegion::flyable, 100, 7);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i], many[i]);
  EXPECT_NE(few[0], random_states(patchwork(), StartRegion::flyable, 1, 8)[0]);
}

TEST(StartStates, AreNoneWhenThereIsNoSuchCell) {
  Plan plan = patchwork();
  plan.region.assign(plan.grid.size(), Region::obstacle);
  EXPECT_TRUE(random_states(plan, StartRegion::not_obstacle, 10, 1).empty());
}

}  // namespace
}  // namespace fairway
