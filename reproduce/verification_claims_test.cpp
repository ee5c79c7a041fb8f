// What the text of paper 2 says about its figures.
#include <gtest/gtest.h>

#include "reproduce/cell_set_figures.hpp"
#include "reproduce/expansion_figures.hpp"

namespace fairway::reproduce {
namespace {

TEST(VerificationClaims, OnlyATightTurnLeavesPlacesFromWhichTheTopIsOutOfReach) {
  const CellSetFigures figures = draw_cell_sets();
  EXPECT_EQ(figures.unreachable_8a, 0.0);   // "for every point there exists a solution"
  EXPECT_GT(figures.unreachable_8b, 0.01);  // "not reachable from some locations"
  EXPECT_LT(figures.unreachable_8b, 0.5);
}

TEST(VerificationClaims, TheFastPassGivesTheBitsOfAlgorithm1AtThePapersSize) {
  const ExpansionFigures figures = draw_expansion();
  EXPECT_EQ(figures.states, 30'400'000U);  // "3.04e7"
  EXPECT_EQ(8 * figures.stored_bytes, figures.states);
  EXPECT_TRUE(figures.algorithm_1_agrees);
  EXPECT_GT(figures.sweeps, 2);
  EXPECT_GT(figures.volume_share, 0.5);
  EXPECT_LT(figures.volume_share, 1.0);
  EXPECT_EQ(figures.border_shares[0], 1.0);  // S1 is the whole border
  for (const double share : figures.border_shares) EXPECT_GT(share, 0.0);
  EXPECT_LT(figures.border_shares[1], 0.5);  // half of all headings do not even enter
}

}  // namespace
}  // namespace fairway::reproduce
