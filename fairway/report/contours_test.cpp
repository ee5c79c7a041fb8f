#include "fairway/report/contours.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

std::vector<float> cone(int n, double cx, double cy) {
  std::vector<float> value;
  for (int iy = 0; iy < n; ++iy)
    for (int ix = 0; ix < n; ++ix)
      value.push_back(static_cast<float>(std::hypot(ix - cx, iy - cy)));
  return value;
}

double worst_radius_error(int n, double radius) {
  const double c = 0.5 * n + 0.137;
  const auto lines = contour_lines(n, n, cone(n, c, c), radius);
  EXPECT_EQ(lines.size(), 1U);
  double worst = 0.0;
  for (const auto& line : lines)
    for (const Vec2 p : line) worst = std::max(worst, std::abs(norm(p - Vec2{c, c}) - radius));
  return worst;
}

TEST(Contours, OfAConeAreClosedCircles) {
  const auto lines = contour_lines(41, 41, cone(41, 20.3, 19.8), 12.25);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  double turned = 0.0;
  for (std::size_t i = 1; i < lines[0].size(); ++i) {
    const Vec2 a = lines[0][i - 1] - Vec2{20.3, 19.8};
    const Vec2 b = lines[0][i] - Vec2{20.3, 19.8};
    EXPECT_NEAR(norm(b), 12.25, 0.012);
    turned += std::atan2(cross(a, b), dot(a, b));
  }
  EXPECT_NEAR(std::abs(turned), 2.0 * M_PI, 1e-9);
}

TEST(Contours, ComeNearerToTheTrueCircleAsTheLatticeGetsFiner) {
  // Half the relative step, a quarter of the relative error.
  const double coarse = worst_radius_error(40, 10.0) / 10.0;
  const double fine = worst_radius_error(160, 40.0) / 40.0;
  EXPECT_LT(fine, coarse / 8.0);
}

TEST(Contours, OfAPlaneRunFromRimToRim) {
  std::vector<float> value;
  for (int iy = 0; iy < 5; ++iy)
    for (int ix = 0; ix < 7; ++ix) value.push_back(static_cast<float>(ix));
  const auto lines = contour_lines(7, 5, value, 2.5);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].size(), 5U);
  for (const Vec2 p : lines[0]) EXPECT_DOUBLE_EQ(p.x, 2.5);
}

TEST(Contours, AHoleInTheSamplesCutsTheLine) {
  std::vector<float> value;
  for (int iy = 0; iy < 7; ++iy)
    for (int ix = 0; ix < 7; ++ix) value.push_back(static_cast<float>(ix));
  value[3 * 7 + 3] = missing;
  const auto lines = contour_lines(7, 7, value, 2.5);
  ASSERT_EQ(lines.size(), 2U);
  for (const auto& line : lines)
    for (const Vec2 p : line) EXPECT_TRUE(p.y <= 2.0 || p.y >= 4.0);
}

TEST(Contours, AreNoneForNoSamplesOneSampleOrALevelOutside) {
  EXPECT_TRUE(contour_lines(0, 0, {}, 1.0).empty());
  EXPECT_TRUE(contour_lines(1, 1, std::vector<float>{1.0F}, 1.0).empty());
  EXPECT_TRUE(contour_lines(3, 3, cone(3, 1, 1), 99.0).empty());
  EXPECT_TRUE(contour_lines(2, 2, std::vector<float>(4, missing), 0.0).empty());
}

/// Every crossed edge of a usable square must be visited exactly once: nothing lost, no line twice.
RC_GTEST_PROP(Contours, VisitEveryCrossedEdgeExactlyOnce, (std::uint64_t seed)) {
  Random random(seed);
  const int nx = 2 + static_cast<int>(random.below(8));
  const int ny = 2 + static_cast<int>(random.below(8));
  std::vector<float> value;
  for (int i = 0; i < nx * ny; ++i)
    value.push_back(random.below(8) == 0 ? missing : static_cast<float>(random.below(4)));
  const double level = 0.5 + static_cast<double>(random.below(3));
  const auto at = [&](int x, int y) { return value[static_cast<std::size_t>(y * nx + x)]; };
  const auto usable = [&](int x, int y) {
    return x >= 0 && y >= 0 && x + 1 < nx && y + 1 < ny &&
           std::isfinite(at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1));
  };
  std::size_t crossed = 0;
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) {
      if (x + 1 < nx && (usable(x, y) || usable(x, y - 1)))
        crossed += (at(x, y) >= level) != (at(x + 1, y) >= level) ? 1U : 0U;
      if (y + 1 < ny && (usable(x, y) || usable(x - 1, y)))
        crossed += (at(x, y) >= level) != (at(x, y + 1) >= level) ? 1U : 0U;
    }
  std::size_t visited = 0;
  for (const auto& line : contour_lines(nx, ny, value, level)) {
    RC_ASSERT(line.size() >= 2U);
    const bool closed = line.size() > 3 && line.front() == line.back();
    visited += line.size() - (closed ? 1U : 0U);
    for (std::size_t i = 1; i < line.size(); ++i)  // consecutive vertices share a square
      RC_ASSERT(std::abs(line[i].x - line[i - 1].x) <= 1.0 &&
                std::abs(line[i].y - line[i - 1].y) <= 1.0);
  }
  RC_ASSERT(visited == crossed);
}

TEST(Contours, ASampleEqualToTheLevelCountsAsAboveIt) {
  Random random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<float> value;
    for (int i = 0; i < 36; ++i) value.push_back(static_cast<float>(random.below(4)));
    const auto tied = contour_lines(6, 6, value, 2.0);
    const auto below = contour_lines(6, 6, value, 2.0 - 1e-6);
    ASSERT_EQ(tied.size(), below.size());
    for (std::size_t l = 0; l < tied.size(); ++l) {
      ASSERT_EQ(tied[l].size(), below[l].size());
      for (std::size_t i = 0; i < tied[l].size(); ++i)
        EXPECT_LT(norm(tied[l][i] - below[l][i]), 2e-6);
    }
  }
}

}  // namespace
}  // namespace fairway
