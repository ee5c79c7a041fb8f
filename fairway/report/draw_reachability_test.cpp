#include "fairway/report/draw_reachability.hpp"

#include <gtest/gtest.h>

#include "fairway/cellular/compute_cell_sets.hpp"
#include "fairway/report/draw_cell_sets.hpp"
#include "fairway/report/testing/reading_pictures.hpp"

namespace fairway {
namespace {

using testing::has_layer;
using testing::has_text;

/// Three of four cells ordinary: one reaches at every heading, one at none, one is undecided.
ReachabilityMap four_cells() {
  ReachabilityMap map;
  map.places = VerdictMap::over({2, 2, 0.0, 0.0, 8.0}, 2, 256);
  map.places.kind[3] = CellKind::obstacle;
  map.headings_per_sample = 10;
  map.count = {{{0, 10, 0}}, {{0, 0, 10}}, {{10, 0, 0}}, {}};
  map.answer = {Sampled::reach, Sampled::other, Sampled::undecided, Sampled::undecided,
                Sampled::reach, Sampled::reach, Sampled::undecided, Sampled::undecided};
  return map;
}

TEST(ReachabilityPictures, SaySharesOfTheOrdinaryCellsAndThatTheyAreNotAProof) {
  const Picture slices = draw_reachability_slices(four_cells(), {.title = "t"});
  EXPECT_TRUE(has_text(slices.svg, "33.3 % reach"));
  EXPECT_TRUE(has_text(slices.svg, "66.7 % reach"));
  EXPECT_TRUE(has_text(slices.svg, "a picture, not a proof"));
  EXPECT_TRUE(has_text(slices.svg, "samples disagree"));
  EXPECT_TRUE(has_layer(slices.svg, "panel-2"));
  EXPECT_FALSE(has_layer(slices.svg, "panel-3"));
  const Picture shares = draw_reachability_shares(four_cells(), {});
  EXPECT_TRUE(has_text(shares.svg, "of 10 headings per cell"));
  EXPECT_TRUE(has_text(shares.svg, "33.3 %"));
  EXPECT_TRUE(has_layer(shares.svg, "panel-3"));
}

TEST(CellSetPictures, HaveAPanelForEachBorderOfBothSets) {
  const CellSets sets = compute_cell_sets(Direction::of(Heading::from_rad(0.7)), {8.0, 20.0}, 12);
  const Picture picture = draw_cell_sets(sets, "Cell (1, 2)");
  for (const Side side : all_sides) {
    EXPECT_TRUE(has_layer(picture.svg, std::string("theta-") + name_of(side)));
    EXPECT_TRUE(has_layer(picture.svg, std::string("phi-") + name_of(side)));
  }
  EXPECT_TRUE(has_text(picture.svg, "Cell (1, 2)"));
}

}  // namespace
}  // namespace fairway
