#include "fairway/verify/region_of_interest.hpp"

#include <gtest/gtest.h>

namespace fairway {
namespace {

using Of = RegionOfInterest::Kind;

TEST(RegionOfInterest, ARectangleTakesTheCellsWhollyInside) {
  const Grid grid{4, 3, 10.0, 20.0, 2.0};
  std::vector<Region> region(grid.size(), Region::free);
  region[grid.index({2, 2})] = Region::obstacle;
  region[grid.index({0, 0})] = Region::goal;
  const RegionOfInterest asked{Of::rectangle, {11.9, 22.0, 18.0, 26.0}};
  const auto cells = target_cells(grid, region, asked);
  const auto kind = cell_kinds(grid, region, asked);
  for (int iy = 0; iy < 3; ++iy) {
    for (int ix = 0; ix < 4; ++ix) {
      const bool obstacle = ix == 2 && iy == 2;
      EXPECT_EQ(cells[grid.index({ix, iy})] != 0, ix >= 1 && iy >= 1 && !obstacle);
      EXPECT_EQ(kind[grid.index({ix, iy})] == CellKind::obstacle, obstacle);
    }
  }
}

TEST(RegionOfInterest, ARectangleSmallerThanACellTakesNone) {
  const Grid grid{4, 3, 0.0, 0.0, 2.0};
  const std::vector<Region> region(grid.size(), Region::free);
  for (const std::uint8_t cell : target_cells(grid, region, {Of::rectangle, {0.1, 0.0, 2.0, 2.0}}))
    EXPECT_EQ(cell, 0);
}

TEST(RegionOfInterest, WithObstaclesAsTheRegionTheGoalIsOrdinary) {
  const Grid grid{3, 1, 0.0, 0.0, 2.0};
  const std::vector<Region> region{Region::goal, Region::obstacle, Region::buffer};
  EXPECT_EQ(cell_kinds(grid, region, {Of::obstacle, {}}),
            (std::vector{CellKind::ordinary, CellKind::target, CellKind::ordinary}));
  EXPECT_EQ(cell_kinds(grid, region, {}),
            (std::vector{CellKind::target, CellKind::obstacle, CellKind::ordinary}));
}

}  // namespace
}  // namespace fairway
