#include <gtest/gtest.h>

#include <cmath>

#include "fairway/base/heading.hpp"
#include "fairway/field/direction_field.hpp"
#include "fairway/field/testing/sample_maps.hpp"
#include "fairway/field/turning_field.hpp"

namespace fairway {
namespace {

constexpr Grid grid{30, 12, 0.0, 0.0, 1.0};

/// A street along x, seven cells wide.
std::vector<Region> street() {
  std::vector<Region> region(grid.size(), Region::obstacle);
  for (int iy = 2; iy < 9; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) region[grid.index({ix, iy})] = Region::free;
  }
  return region;
}

double component_to(const std::vector<float>& heading_rad, Cell c, double rad) {
  return std::cos(static_cast<double>(heading_rad[grid.index(c)]) - rad);
}

TEST(DirectionField, GoesOnInTheMiddleAndBendsOffWalls) {
  const std::vector<float> east = direction_field(grid, street(), 0.0, 3.0);
  EXPECT_EQ(east[grid.index({15, 5})], 0.0F);
  EXPECT_TRUE(std::isnan(east[grid.index({15, 0})]));
  EXPECT_GT(east[grid.index({15, 2})], 0.1F);   // off the lower wall
  EXPECT_LT(east[grid.index({15, 8})], -0.1F);  // off the upper one
}

TEST(DirectionField, RunsAlongAWallThatItMeetsAtAnAngle) {
  const std::vector<float> field = direction_field(grid, street(), pi / 4, 3.0);
  EXPECT_NEAR(field[grid.index({15, 5})], pi / 4, 0.3);
  // Beside the upper wall it no longer points into it.
  EXPECT_LT(field[grid.index({15, 8})], 0.1F);
  EXPECT_GT(component_to(field, {15, 8}, 0.0), 0.3);
}

TEST(DirectionField, IsTheDirectionWithoutWalls) {
  const std::vector<Region> open(grid.size(), Region::free);
  for (const double rad : {0.0, 1.0, 2.5, -3.0}) {
    const std::vector<float> field = direction_field(grid, open, rad, 2.0);
    EXPECT_NEAR(field[grid.index({15, 6})], rad, 1e-5);
  }
}

TEST(TurningField, LeadsToThePlacesFromBothSides) {
  std::vector<std::uint8_t> places(grid.size(), 0);
  places[grid.index({20, 5})] = 1;
  const std::vector<float> field = turning_field(grid, street(), places, 2.0);
  EXPECT_GT(component_to(field, {5, 5}, 0.0), 0.99);
  EXPECT_GT(component_to(field, {28, 5}, pi), 0.99);
  EXPECT_TRUE(std::isnan(field[grid.index({20, 5})]));
  EXPECT_TRUE(std::isnan(field[grid.index({5, 0})]));
}

TEST(TurningField, HasNoCommandWithoutPlacesOrBehindAWall) {
  std::vector<std::uint8_t> places(grid.size(), 0);
  for (const float h : turning_field(grid, street(), places, 2.0)) EXPECT_TRUE(std::isnan(h));
  std::vector<Region> walled = street();
  for (int iy = 0; iy < grid.ny; ++iy) walled[grid.index({10, iy})] = Region::obstacle;
  places[grid.index({20, 5})] = 1;
  const std::vector<float> field = turning_field(grid, walled, places, 2.0);
  EXPECT_TRUE(std::isnan(field[grid.index({5, 5})]));
  EXPECT_FALSE(std::isnan(field[grid.index({15, 5})]));
}

}  // namespace
}  // namespace fairway
