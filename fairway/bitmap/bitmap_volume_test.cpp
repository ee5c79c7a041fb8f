#include "fairway/bitmap/bitmap_volume.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/bitmap/bitmap_backward.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {
namespace {

/// Towards a goal in the middle with a swirl, one obstacle; away from (0, 0) on purpose.
Plan swirl(int n) {
  Plan plan;
  plan.grid = {n, n, -35.0, 12.0, 8.0};
  plan.vehicle = {10.0, 20.0};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  const Vec2 goal = plan.grid.corner({n / 2, n / 2});
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    const Vec2 to_goal = goal - plan.grid.center(c);
    plan.heading_rad.push_back(
        Heading::stored(std::atan2(to_goal.y, to_goal.x) + 0.6 * std::sin(0.4 * c.ix)));
    if (norm(to_goal) < 40.0) plan.region[i] = Region::goal;
    if (c.ix >= 3 && c.ix < 6 && c.iy >= 5 && c.iy < 9) plan.region[i] = Region::obstacle;
  }
  return plan;
}

TEST(VolumeShare, AgreesWithExactFlightsFromAnywhere) {
  const Plan plan = swirl(20);
  const auto target = target_cells(plan.grid, plan.region, {});
  const BorderBitmap set = backward_reachable_set(plan, target, {200});
  const BitmapLookup lookup(plan, target, set);
  const ExactFlights flights(plan);
  Random random(31);
  int contradictions = 0;
  int reached = 0;
  const int draws = 20'000;
  for (int draw = 0; draw < draws; ++draw) {
    const Vec2 p{-35.0 + 160.0 * random.unit(), 12.0 + 160.0 * random.unit()};
    const State state{p, Heading::from_rad(random.uniform(-pi, pi))};
    const bool exact = flights.fly(state).outcome == Outcome::reach;
    reached += exact ? 1 : 0;
    contradictions += lookup.reaches(state) != exact ? 1 : 0;
  }
  EXPECT_GT(reached, draws / 2);
  EXPECT_LT(reached, draws - draws / 20);
  EXPECT_LT(contradictions, draws / 200);  // samples prove nothing, but come close
}

TEST(VolumeShare, IsThatOfALoopOverDrawsAndTheSameForAnyNumberOfThreads) {
  const Plan plan = swirl(12);
  const auto target = target_cells(plan.grid, plan.region, {});
  const BorderBitmap set = backward_reachable_set(plan, target, {40});
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control bound(tbb::global_control::max_allowed_parallelism, threads);
    return volume_share_reached(plan, target, set, 50'000, 9);
  };
  const VolumeShare one = with_threads(1);
  const VolumeShare four = with_threads(4);
  EXPECT_EQ(one.reached, four.reached);
  EXPECT_GT(one.reached, 0.2);
  EXPECT_LT(one.reached, 1.0);
  const VolumeShare other = volume_share_reached(plan, target, set, 50'000, 10);
  EXPECT_NE(one.reached, other.reached);
  EXPECT_NEAR(one.reached, other.reached, 6.0 * one.standard_error);
}

TEST(VolumeShare, OfAGridWithoutOpenCellsIsNothing) {
  Plan plan = swirl(2);
  plan.region.assign(4, Region::obstacle);
  const auto target = target_cells(plan.grid, plan.region, {});
  const BorderBitmap set = backward_reachable_set(plan, target, {8});
  EXPECT_EQ(volume_share_reached(plan, target, set, 100).reached, 0.0);
  EXPECT_EQ(volume_share_reached(plan, target, set, 100).draws, 0U);
}

TEST(BitmapLookup, AnswersForRegionObstacleAndOutsideWithoutAFlight) {
  const Plan plan = swirl(12);
  const auto target = target_cells(plan.grid, plan.region, {});
  const BorderBitmap set = backward_reachable_set(plan, target, {8});
  const BitmapLookup lookup(plan, target, set);
  EXPECT_TRUE(lookup.reaches({plan.grid.center({6, 6}), {}}));
  EXPECT_FALSE(lookup.reaches({plan.grid.center({4, 6}), {}}));
  EXPECT_FALSE(lookup.reaches({{-35.1, 20.0}, {}}));
  EXPECT_FALSE(lookup.reaches({{std::nan(""), 20.0}, {}}));
}

TEST(BitmapLookup, RefusesABitmapOfAnotherGrid) {
  const Plan plan = swirl(12);
  const Plan other = swirl(11);
  const auto target = target_cells(plan.grid, plan.region, {});
  const BorderBitmap set =
      backward_reachable_set(other, target_cells(other.grid, other.region, {}), {8});
  EXPECT_THROW(BitmapLookup(plan, target, set), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
