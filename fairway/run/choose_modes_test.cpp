#include "fairway/run/choose_modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "fairway/run/plan_map.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/vehicle/modes.hpp"
#include "fairway/verify/ask_modes.hpp"

namespace fairway {
namespace {

constexpr auto reach = static_cast<std::size_t>(Verdict::reach);

/// A street of one cell less than two turning circles, closed behind, that opens into a square with
/// the goal: who points the wrong way cannot turn round in the street.
Plan plan_of_a_street() {
  ObstacleMap map;
  map.grid = {40, 24, 0.0, 0.0, 1.0};
  map.obstacle.assign(map.grid.size(), 1);
  const auto clear = [&](int x0, int x1, int y0, int y1) {
    for (int iy = y0; iy < y1; ++iy) {
      for (int ix = x0; ix < x1; ++ix) map.obstacle[map.grid.index({ix, iy})] = 0;
    }
  };
  clear(1, 14, 2, 22);   // a square with room to turn
  clear(14, 26, 9, 14);  // the street
  clear(26, 39, 2, 22);  // another square
  FieldOptions options;
  options.alpha = 0.5;
  options.beta = 0.8;
  auto answer = plan_map(map, {1.0, 2.4}, GoalMission{{7.0, 12.0}, {}}, options);
  return std::get<Plan>(std::move(answer));
}

TEST(ChooseModes, BringsWhoPointsTheWrongWayInAStreet) {
  Plan plan = plan_of_a_street();
  CertifyOptions options;
  options.samples = 50000;
  const double alone = verify_plan(plan, "plan", {}, options).outcome.volume.all[reach];
  const ChosenModes chosen = choose_modes(plan, "plan");
  ASSERT_FALSE(chosen.records.empty());
  EXPECT_TRUE(are_worth_it(chosen));
  EXPECT_NEAR(chosen.alone, alone, 0.03);  // a coarser proof, another sample
  plan.mode_heading_rad = chosen.heading_rad;
  plan.record.modes = chosen.records;
  const Verification proved = verify_plan(plan, "plan", {}, options);
  const VolumeFractions& volume = proved.outcome.volume;
  EXPECT_GT(volume.all[reach], alone + 0.05);
  // What each was chosen for is proved, but for what lies along the edges.
  const double hoped = std::accumulate(chosen.gain.begin(), chosen.gain.end(), chosen.alone);
  EXPECT_GT(volume.all[reach], hoped - 0.03);
  EXPECT_NEAR(std::accumulate(volume.reach_by_mode.begin(), volume.reach_by_mode.end(), 0.0),
              volume.all[reach], 1e-9);
  // Pointing out of the street, in its middle: the plan's own field would turn it into the wall.
  const ProvedState known = ask_all_modes(proved.certificate.view(), 20.0, 11.5, 0.01);
  EXPECT_EQ(known.verdict, Verdict::reach);
  EXPECT_GT(known.mode, 0);
  EXPECT_EQ(ask_mode(proved.certificate.view(), 0, 20.0, 11.5, 0.01).only(), Verdict::collide);
}

TEST(ChooseModes, ChoosesNoMoreThanAskedAndTheBestFirst) {
  const Plan plan = plan_of_a_street();
  ModeOptions one;
  one.most = 1;
  const ChosenModes best = choose_modes(plan, "plan", one);
  ASSERT_EQ(best.records.size(), 1U);
  const ChosenModes all = choose_modes(plan, "plan");
  EXPECT_EQ(all.records.front(), best.records.front());
  EXPECT_TRUE(std::is_sorted(all.gain.rbegin(), all.gain.rend()));
  EXPECT_LT(all.records.size(), most_modes);
}

TEST(ChooseModes, NoneEarnsAnythingWhereThePlanBringsAll) {
  ObstacleMap map;
  map.grid = {60, 60, 0.0, 0.0, 1.0};
  map.obstacle.assign(map.grid.size(), 0);
  auto answer = plan_map(map, {1.0, 1.5}, GoalMission{{30.0, 30.0}, {}}, FieldOptions{});
  const Plan plan = std::get<Plan>(std::move(answer));
  ModeOptions options;
  options.least_gain = 0.05;
  EXPECT_TRUE(choose_modes(plan, "plan", options).records.empty());
  EXPECT_FALSE(are_worth_it({}));
}

}  // namespace
}  // namespace fairway
