#include "fairway/bitmap/bitmap_lookup.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/bitmap/sample_bitmap.hpp"
#include "fairway/bitmap/testing/sample_bitmaps.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway {
namespace {

State random_state(const Grid& grid, Random& random) {
  return {{grid.x0_m + grid.width_m() * random.unit(), grid.y0_m + grid.height_m() * random.unit()},
          Heading::from_rad(random.uniform(-pi, pi))};
}

TEST(BitmapLookup, ContradictionsToExactFlightsNearAnEdgeAreUndecided) {
  Random random(77);
  int decided = 0;
  int undecided = 0;
  int by_one_sample = 0;
  int contradictions = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Plan plan = swirled_plan(24, random);
    const Bitmap bitmap = bitmap_of(plan, {}, 100);
    const BitmapLookup lookup(bitmap);
    const ExactFlights flights(plan);
    for (int draw = 0; draw < 2'000; ++draw) {
      const State state = random_state(plan.grid, random);
      const bool reaches = flights.fly(state).outcome == Outcome::reach;
      by_one_sample += lookup.reaches(state) != reaches ? 1 : 0;
      const Sampled answer = lookup.answer(state);
      if (answer == Sampled::undecided) {
        ++undecided;
        continue;
      }
      ++decided;
      EXPECT_EQ(answer == Sampled::reach, lookup.reaches(state));
      contradictions += (answer == Sampled::reach) != reaches ? 1 : 0;
    }
  }
  EXPECT_GT(by_one_sample, 100);
  EXPECT_LT(10 * contradictions, by_one_sample);  // 9 of 10 and more lie within one sample
  EXPECT_LT(contradictions, decided / 1000);      // the rest comes from repeated snapping
  EXPECT_GT(undecided, decided / 100);
  EXPECT_LT(undecided, decided / 5);
}

TEST(BitmapLookup, KnowsRegionObstaclesAndTheOutsideOfAnyRegionOfInterest) {
  Random random(5);
  Plan plan = swirled_plan(12, random);
  const Cell wall{2, 3};
  plan.region[plan.grid.index(wall)] = Region::obstacle;
  RegionOfInterest cells{RegionOfInterest::Kind::cells, {}, {}};
  cells.cells.assign(plan.grid.size(), 0);
  cells.cells[plan.grid.index({1, 1})] = 1;
  cells.cells[plan.grid.index(wall)] = 1;  // still an obstacle
  plan.region[plan.grid.index({1, 1})] = Region::free;
  const Bitmap bitmap = bitmap_of(plan, cells, 8);
  const BitmapLookup lookup(bitmap);
  EXPECT_EQ(lookup.answer({plan.grid.center({1, 1}), {}}), Sampled::reach);
  EXPECT_EQ(lookup.answer({plan.grid.center(wall), {}}), Sampled::other);
  EXPECT_EQ(lookup.answer({{plan.grid.x0_m - 0.1, 20.0}, {}}), Sampled::other);
  EXPECT_EQ(lookup.answer({{std::nan(""), 20.0}, {}}), Sampled::other);
  const Vec2 beside = plan.grid.center({plan.grid.nx - 1, 0});
  EXPECT_EQ(lookup.answer({{beside.x + 3.9, beside.y}, {}}), Sampled::other) << "out of the grid";
}

TEST(ReachabilityMap, IsTheAnswersOfALoopOverItsPlacesAndHeadings) {
  Random random(6);
  const Plan plan = swirled_plan(13, random);
  const Bitmap bitmap = bitmap_of(plan, {}, 40);
  const ReachabilityMap map = reachability_map_of(bitmap, {3, 10, 7});
  const VerdictMap& places = map.places;
  ASSERT_EQ(places.cells_per_sample, 3);
  ASSERT_EQ(map.answer.size(), 3 * places.samples());
  std::vector<State> states;
  for (const double heading_rad : places.heading_rad) {
    for (std::size_t i = 0; i < places.samples(); ++i)
      states.push_back({places.place_m(i), Heading::from_rad(heading_rad)});
  }
  const std::vector<Sampled> answers = sampled_answers(bitmap, states);
  for (std::size_t i = 0; i < places.samples(); ++i) {
    const bool ordinary =
        bitmap.kind[plan.grid.index(places.cell_of_sample(i))] == CellKind::ordinary;
    int sum = 0;
    for (const std::uint16_t count : map.count[i]) sum += count;
    EXPECT_EQ(sum, ordinary ? 10 : 0);
    for (std::size_t h = 0; h < 3; ++h) {
      EXPECT_EQ(map.answer_at(h, i),
                ordinary ? answers[h * places.samples() + i] : Sampled::undecided);
    }
  }
}

}  // namespace
}  // namespace fairway
