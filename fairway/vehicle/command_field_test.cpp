#include "fairway/vehicle/command_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

constexpr float no_command = std::numeric_limits<float>::quiet_NaN();

struct Drawn {
  Grid grid;
  std::vector<float> heading_rad;
};

Drawn drawn(Random& random) {
  Drawn d;
  d.grid = {1 + static_cast<int>(random.below(14)), 1 + static_cast<int>(random.below(11)),
            random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), random.uniform(0.5, 3.0)};
  const double share = random.below(4) == 0 ? 0.03 : random.unit();
  for (std::size_t i = 0; i < d.grid.size(); ++i) {
    const bool has = random.unit() < share;
    d.heading_rad.push_back(has ? static_cast<float>(random.uniform(-3.0, 3.0)) : no_command);
  }
  return d;
}

/// By the words of the contract, cell by cell: of the nearest centres the first in the array.
double by_the_words(const Drawn& d, Cell cell) {
  const auto own = static_cast<double>(d.heading_rad[d.grid.index(cell)]);
  if (!std::isnan(own)) return own;
  long least = std::numeric_limits<long>::max();
  double found = own;
  for (std::size_t i = 0; i < d.grid.size(); ++i) {
    if (std::isnan(d.heading_rad[i])) continue;
    const Cell other = d.grid.cell_at(i);
    const long dx = other.ix - cell.ix;
    const long dy = other.iy - cell.iy;
    if (dx * dx + dy * dy < least) {
      least = dx * dx + dy * dy;
      found = static_cast<double>(d.heading_rad[i]);
    }
  }
  return found;
}

void expect_same(double a, double b) {
  EXPECT_EQ(std::isnan(a), std::isnan(b));
  if (!std::isnan(b)) {
    EXPECT_EQ(a, b);
  }
}

TEST(CommandFields, AnswerForEveryPlaceOnTheGridWithTheNearestCommandFirstOfEquals) {
  Random random(1);
  for (int round = 0; round < 150; ++round) {
    const Drawn d = drawn(random);
    const CommandField field(d.grid, d.heading_rad.data());
    for (std::size_t i = 0; i < d.grid.size(); ++i) {
      const Cell cell = d.grid.cell_at(i);
      const Vec2 at = d.grid.corner(cell) + d.grid.cell_m * Vec2{random.uniform(0.001, 0.999),
                                                                 random.uniform(0.001, 0.999)};
      expect_same(field.command_rad(at.x, at.y), by_the_words(d, cell));
    }
  }
}

TEST(CommandFields, AnswerOutsideTheGridAsAtTheNearestPlaceOnIt) {
  Random random(2);
  constexpr double far[] = {1e-3, 1.0, 1e3, 1e9, 1e300, std::numeric_limits<double>::infinity()};
  for (int round = 0; round < 150; ++round) {
    const Drawn d = drawn(random);
    const Grid& g = d.grid;
    const CommandField field(g, d.heading_rad.data());
    for (const double off : far) {
      const int iy = static_cast<int>(random.below(static_cast<std::uint64_t>(g.ny)));
      const int ix = static_cast<int>(random.below(static_cast<std::uint64_t>(g.nx)));
      const Vec2 middle = g.center({ix, iy});
      const double right = g.x0_m + g.width_m() + off;
      const double top = g.y0_m + g.height_m() + off;
      expect_same(field.command_rad(g.x0_m - off, middle.y), by_the_words(d, {0, iy}));
      expect_same(field.command_rad(right, middle.y), by_the_words(d, {g.nx - 1, iy}));
      expect_same(field.command_rad(middle.x, g.y0_m - off), by_the_words(d, {ix, 0}));
      expect_same(field.command_rad(middle.x, top), by_the_words(d, {ix, g.ny - 1}));
      expect_same(field.command_rad(right, top), by_the_words(d, {g.nx - 1, g.ny - 1}));
    }
  }
}

TEST(CommandFields, OnABorderAnswerWithOneOfItsCells) {
  const Grid grid{2, 1, 0.0, 0.0, 4.0};
  const std::vector<float> commands{0.5F, 1.5F};
  const CommandField field(grid, commands.data());
  EXPECT_EQ(field.command_rad(0.0, 0.0), 0.5);
  EXPECT_EQ(field.command_rad(4.0, 2.0), 1.5);
  EXPECT_EQ(field.command_rad(8.0, 4.0), 1.5);
}

TEST(CommandFields, HaveNoCommandOnlyWithoutAnyOrForNoPlace) {
  const Grid grid{3, 2, 0.0, 0.0, 4.0};
  const std::vector<float> none(6, no_command);
  EXPECT_TRUE(std::isnan(CommandField(grid, none.data()).command_rad(1.0, 1.0)));
  std::vector<float> one = none;
  one[4] = 2.0F;
  const CommandField field(grid, one.data());
  EXPECT_EQ(field.command_rad(11.0, 1.0), 2.0);
  EXPECT_TRUE(std::isnan(field.command_rad(NAN, 1.0)));
  EXPECT_TRUE(std::isnan(field.command_rad(1.0, NAN)));
}

TEST(PointsAhead, LieOnTheCourseAtTheirDistance) {
  const Vec2 ahead = point_ahead(10.0, 20.0, 0.5 * pi, 6.0);
  EXPECT_NEAR(ahead.x, 10.0, 1e-12);
  EXPECT_NEAR(ahead.y, 26.0, 1e-12);
  EXPECT_EQ(point_ahead(1.0, 2.0, 0.3, 0.0), (Vec2{1.0, 2.0}));
}

}  // namespace
}  // namespace fairway
