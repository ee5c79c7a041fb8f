#include "fairway/report/tube_outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway {
namespace {

FollowProof circle_of(double radius_m, std::vector<float> distances_m) {
  FollowProof proof;
  proof.path.closed = true;
  for (int k = 0; k < 240; ++k) {
    const double angle = two_pi * k / 240.0;
    proof.path.vertices_m.push_back(
        {30.0 + radius_m * std::cos(angle), radius_m * std::sin(angle)});
  }
  for (const float d : distances_m) proof.tube.push_back({d, 0.1F});
  return proof;
}

double area_to_the_left(const std::vector<std::vector<Vec2>>& lines) {
  double twice = 0.0;
  for (const auto& line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i) twice += cross(line[i - 1], line[i]);
  }
  return 0.5 * twice;
}

TEST(TubeOutline, AboutACircleIsARingWithAHole) {
  const auto lines = tube_outline(circle_of(50.0, {8.0F}), 1.0);
  ASSERT_EQ(lines.size(), 2U);
  for (const auto& line : lines) {
    EXPECT_EQ(line.front(), line.back());
    for (const Vec2 p : line) {
      EXPECT_NEAR(std::abs(norm(p - Vec2{30.0, 0.0}) - 50.0), 8.0, 0.05);
    }
  }
  EXPECT_NEAR(area_to_the_left(lines), 4.0 * pi * 50.0 * 8.0, 10.0);
}

TEST(TubeOutline, WiderThanItsCircleHasNoHole) {
  const auto lines = tube_outline(circle_of(20.0, {26.0F}), 1.0);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(area_to_the_left(lines), pi * 46.0 * 46.0, 10.0);
}

TEST(TubeOutline, IsAsWideAsEachStretch) {
  // The upper half of the circle first, then the lower.
  const FollowProof proof = circle_of(50.0, {12.0F, 4.0F});
  EXPECT_EQ(widest_m(proof), 12.0);
  double highest = 0.0;
  double lowest = 0.0;
  for (const auto& line : tube_outline(proof, 1.0)) {
    for (const Vec2 p : line) {
      highest = std::max(highest, p.y);
      lowest = std::min(lowest, p.y);
    }
  }
  EXPECT_NEAR(highest, 62.0, 0.1);
  EXPECT_NEAR(lowest, -54.0, 0.1);
}

RC_GTEST_PROP(TubeOutline, LinesLeaveHolesOutWhereverTheWidthJumps, (std::uint64_t seed)) {
  Random random(seed);
  FollowProof proof;
  proof.path.closed = true;
  for (int k = 0; k < 9; ++k) {
    const double angle = two_pi * k / 9.0;
    const double radius_m = random.uniform(60.0, 140.0);
    proof.path.vertices_m.push_back({radius_m * std::cos(angle), radius_m * std::sin(angle)});
  }
  for (int k = 0; k < 60; ++k) {
    proof.tube.push_back({static_cast<float>(random.uniform(6.0, 20.0)), 0.1F});
  }
  const PathLocator path(proof.path);
  double area = 0.0;
  constexpr double step_m = 2.0;
  for (double x = -170.0; x < 170.0; x += step_m) {
    for (double y = -170.0; y < 170.0; y += step_m) {
      const PathPoint nearest = path.nearest({x, y});
      const double k = std::min(59.0, 60.0 * nearest.along_m / path.length_m());
      if (nearest.distance_m <= proof.tube[static_cast<std::size_t>(k)].distance_m) {
        area += step_m * step_m;
      }
    }
  }
  RC_ASSERT(std::abs(area_to_the_left(tube_outline(proof, 1.0)) / area - 1.0) < 0.03);
}

TEST(TubeOutline, OfAnOpenPathEndsInCapsAndACoarseLatticeIsUsedWhereItIsLarge) {
  FollowProof proof;
  proof.path.closed = false;
  proof.path.vertices_m = {{0.0, 0.0}, {30e3, 0.0}};
  proof.tube.push_back({100.0F, 0.1F});
  const auto lines = tube_outline(proof, 0.5);  // would be of 60,000 places across
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_LT(lines[0].size(), 4000U);
  EXPECT_NEAR(area_to_the_left(lines), 200.0 * 30e3 + pi * 1e4, 2e4);
}

}  // namespace
}  // namespace fairway
