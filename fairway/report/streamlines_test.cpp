#include "fairway/report/streamlines.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/report/testing/plans_to_draw.hpp"

namespace fairway {
namespace {

using Lines = std::vector<std::vector<Vec2>>;

double least_distance_between_lines(const Lines& lines) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < lines.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (const Vec2 p : lines[a])
        for (const Vec2 q : lines[b]) least = std::min(least, norm(p - q));
  return least;
}

Plan whirl(const Grid& grid) {
  const Vec2 c{grid.x0_m + 0.5 * grid.width_m(), grid.y0_m + 0.5 * grid.height_m()};
  return testing::plan_of(
      grid, [](Vec2) { return 1.0; },
      [c](Vec2 p) { return std::atan2(p.y - c.y, p.x - c.x) + 0.5 * pi; });
}

TEST(Streamlines, InAUniformFieldAreParallelAndFillTheGrid) {
  const Grid grid{40, 30, 100.0, -50.0, 2.0};
  const double heading = 0.4;
  const Plan plan = testing::plan_of(
      grid, [](Vec2) { return 1.0; }, [&](Vec2) { return heading; });
  const double separation_m = 6.0;
  const Lines lines = evenly_spaced_streamlines(plan, separation_m);
  for (const auto& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i)
      EXPECT_NEAR(Heading::of(line[i] - line[i - 1]).rad(), heading, 1e-6);
  // No hole wider than two separations (seeds stand one separation beside a line; lines shorter
  // than one separation, in the grid's corners, are left out).
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Vec2 p = grid.center(grid.cell_at(i));
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& line : lines)
      for (const Vec2 q : line) nearest = std::min(nearest, norm(p - q));
    EXPECT_LT(nearest, 2.0 * separation_m) << "at " << p.x << ", " << p.y;
  }
}

TEST(Streamlines, OfAWhirlAreCirclesThatDoNotRunOverThemselves) {
  const Grid grid{60, 60, 0.0, 0.0, 1.0};
  const Vec2 c{30.0, 30.0};
  const Lines lines = evenly_spaced_streamlines(whirl(grid), 5.0);
  ASSERT_FALSE(lines.empty());
  for (const auto& line : lines) {
    const double radius = norm(line.front() - c);
    if (radius < 4.0) continue;  // near the eye the field turns within a cell
    double length = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      EXPECT_NEAR(norm(line[i] - c), radius, 0.05 * radius);
      length += norm(line[i] - line[i - 1]);
    }
    EXPECT_LT(length, two_pi * radius);
  }
}

RC_GTEST_PROP(Streamlines, FollowTheFieldAndKeepTheirDistance, (std::uint64_t seed)) {
  Random random(seed);
  const Grid grid{12 + static_cast<int>(random.below(20)), 12 + static_cast<int>(random.below(20)),
                  random.uniform(-100.0, 100.0), random.uniform(-100.0, 100.0),
                  random.uniform(0.5, 5.0)};
  const double kx = random.uniform(0.0, 6.0) / grid.width_m();
  const double ky = random.uniform(0.0, 6.0) / grid.height_m();
  Plan plan = testing::plan_of(
      grid, [](Vec2) { return 1.0; },
      [&](Vec2 p) { return 3.0 * std::sin(kx * p.x) + 2.0 * std::cos(ky * p.y); });
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (random.below(20) == 0) plan.region[i] = Region::obstacle;
    if (random.below(20) == 0) plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
  }
  const double separation_m = random.uniform(1.0, 6.0) * grid.cell_m;
  const Lines lines = evenly_spaced_streamlines(plan, separation_m);
  RC_ASSERT(least_distance_between_lines(lines) >= 0.5 * separation_m);
  for (const auto& line : lines) {
    double length = 0.0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Cell cell = grid.cell_of(line[i]);
      RC_ASSERT(grid.contains(cell));
      RC_ASSERT(plan.region[grid.index(cell)] != Region::obstacle);
      RC_ASSERT(std::isfinite(plan.heading_rad[grid.index(cell)]));
      if (i == 0) continue;
      const Vec2 step = line[i] - line[i - 1];
      length += norm(step);
      // Along the field at the middle of the step, or at least forwards where it turns sharply.
      const auto along = field_direction(plan, 0.5 * (line[i] + line[i - 1]));
      if (along) RC_ASSERT(dot(*along, step) > 0.0);
    }
    RC_ASSERT(length >= 0.999 * separation_m);
  }
}

TEST(Streamlines, AreNoneWithoutCellsOrCommands) {
  EXPECT_TRUE(evenly_spaced_streamlines(Plan{}, 1.0).empty());
  Plan plan = whirl({5, 5, 0.0, 0.0, 1.0});
  for (float& heading : plan.heading_rad) heading = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(evenly_spaced_streamlines(plan, 1.0).empty());
}

TEST(Streamlines, WhereOppositeCommandsMeetThereIsNoDirection) {
  const Grid grid{2, 1, 0.0, 0.0, 1.0};
  const Plan plan = testing::plan_of(
      grid, [](Vec2) { return 1.0; }, [](Vec2 p) { return p.x < 1.0 ? 0.0 : pi; });
  EXPECT_FALSE(field_direction(plan, {1.0, 0.5}).has_value());
  EXPECT_TRUE(field_direction(plan, {0.5, 0.5}).has_value());
  EXPECT_FALSE(field_direction(plan, {-0.1, 0.5}).has_value());
}

TEST(Streamlines, AreTheSameLineAfterTheWorldIsMoved) {
  const Grid here{20, 20, 0.0, 0.0, 4.0};
  const Grid there{20, 20, 4096.0, -8192.0, 4.0};
  const Lines a = evenly_spaced_streamlines(whirl(here), 10.0);
  const Lines b = evenly_spaced_streamlines(whirl(there), 10.0);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].size(), b[i].size());
    for (std::size_t k = 0; k < a[i].size(); ++k)
      EXPECT_LT(norm(b[i][k] - a[i][k] - Vec2{4096.0, -8192.0}), 1e-6);
  }
}

}  // namespace
}  // namespace fairway
