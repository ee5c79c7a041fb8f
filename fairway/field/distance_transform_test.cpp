#include "fairway/field/distance_transform.hpp"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/field/testing/sample_maps.hpp"

namespace fairway {
namespace {

using samples::Mask;

struct Distances {
  std::vector<std::int32_t> squared;
  std::vector<std::uint32_t> nearest;
  friend bool operator==(const Distances&, const Distances&) = default;
};

Distances transformed(const Mask& m) {
  Distances out{std::vector<std::int32_t>(m.cells.size(), -7),
                std::vector<std::uint32_t>(m.cells.size(), 7)};
  distance_transform(m.cells, m.nx, m.ny, {out.squared, out.nearest});
  return out;
}

std::int64_t squared_between(const Mask& m, std::uint32_t a, std::uint32_t b) {
  const auto n = static_cast<std::uint32_t>(m.nx);
  const auto dx = static_cast<std::int64_t>(a % n) - static_cast<std::int64_t>(b % n);
  const auto dy = static_cast<std::int64_t>(a / n) - static_cast<std::int64_t>(b / n);
  return dx * dx + dy * dy;
}

// Every pair of a cell and a feature.
std::vector<std::int32_t> by_all_pairs(const Mask& m) {
  std::vector<std::uint32_t> features;
  for (std::uint32_t i = 0; i < m.cells.size(); ++i) {
    if (m.cells[i] != 0) features.push_back(i);
  }
  std::vector<std::int32_t> out(m.cells.size(), no_feature_distance);
  for (std::uint32_t i = 0; i < m.cells.size(); ++i) {
    for (const std::uint32_t f : features) {
      out[i] = std::min(out[i], static_cast<std::int32_t>(squared_between(m, i, f)));
    }
  }
  return out;
}

void expect_exact(const Mask& m) {
  SCOPED_TRACE(testing::Message() << m.nx << " x " << m.ny << " cells");
  const Distances found = transformed(m);
  ASSERT_EQ(found.squared, by_all_pairs(m));
  for (std::uint32_t i = 0; i < m.cells.size(); ++i) {
    if (found.squared[i] == no_feature_distance) {
      ASSERT_EQ(found.nearest[i], no_feature);
      continue;
    }
    ASSERT_LT(found.nearest[i], m.cells.size());
    ASSERT_NE(m.cells[found.nearest[i]], 0);
    ASSERT_EQ(squared_between(m, i, found.nearest[i]), found.squared[i]);
  }
}

TEST(DistanceTransform, AgreesWithAllPairsOnEveryShapeAndDensity) {
  Random random(31);
  const std::vector<std::array<int, 2>> shapes{{1, 1},   {1, 2},    {2, 1},  {1, 40},  {40, 1},
                                               {2, 2},   {3, 31},   {31, 3}, {16, 16}, {17, 33},
                                               {40, 40}, {1300, 2}, {513, 5}};
  for (const auto& [nx, ny] : shapes) {
    for (const double density : {0.0, 0.003, 0.05, 0.3, 0.9, 1.0}) {
      expect_exact(samples::speckled(random, nx, ny, density));
    }
  }
}

RC_GTEST_PROP(DistanceTransformProperty, AgreesWithAllPairsOnDrawnMaps, ()) {
  const int nx = *rc::gen::inRange(1, 24);
  const int ny = *rc::gen::inRange(1, 24);
  Mask m(nx, ny);
  m.cells = *rc::gen::container<std::vector<std::uint8_t>>(
      m.cells.size(), rc::gen::weightedElement<std::uint8_t>({{6, 0}, {1, 1}, {1, 255}}));
  expect_exact(m);
}

TEST(DistanceTransform, OneFeatureAnywhereIsFoundFromEverywhere) {
  for (int fy = 0; fy < 6; ++fy) {
    for (int fx = 0; fx < 9; ++fx) {
      Mask m(9, 6);
      m.at(fx, fy) = 1;
      expect_exact(m);
    }
  }
}

TEST(DistanceTransform, FeaturesOnACircleTieEverywhereAndStayExact) {
  Mask m(61, 61);
  for (const auto& [dx, dy] :
       std::vector<std::array<int, 2>>{{25, 0}, {24, 7}, {20, 15}, {15, 20}, {7, 24}, {0, 25}}) {
    for (const int sx : {-1, 1}) {
      for (const int sy : {-1, 1}) m.at(30 + sx * dx, 30 + sy * dy) = 1;
    }
  }
  expect_exact(m);
  EXPECT_EQ(transformed(m).squared[m.index(30, 30)], 625);
}

TEST(DistanceTransform, TheLongestSidesFitTheirType) {
  for (const bool along_x : {true, false}) {
    Mask m(along_x ? largest_distance_side : 2, along_x ? 2 : largest_distance_side);
    m.cells.front() = 1;
    const Distances found = transformed(m);
    const std::int64_t far = largest_distance_side - 1;
    EXPECT_EQ(found.squared.back(), far * far + 1);
    EXPECT_EQ(found.nearest.back(), 0U);
  }
}

TEST(DistanceTransform, EachOutputAloneIsTheSameAsBoth) {
  Random random(32);
  const Mask m = samples::speckled(random, 70, 45, 0.02);
  const Distances both = transformed(m);
  std::vector<std::int32_t> squared(m.cells.size());
  std::vector<std::uint32_t> nearest(m.cells.size());
  distance_transform(m.cells, m.nx, m.ny, {squared, {}});
  distance_transform(m.cells, m.nx, m.ny, {{}, nearest});
  EXPECT_EQ(squared, both.squared);
  EXPECT_EQ(nearest, both.nearest);
}

TEST(DistanceTransform, TurnsAndMirrorsWithItsMap) {
  Random random(33);
  for (const double density : {0.001, 0.03, 0.4}) {
    const Mask m = samples::speckled(random, 57, 38, density);
    const std::vector<std::int32_t> squared = transformed(m).squared;
    Mask turned(m.ny, m.nx);
    turned.cells = samples::quarter_turned(m.cells, m.nx, m.ny);
    EXPECT_EQ(transformed(turned).squared, samples::quarter_turned(squared, m.nx, m.ny));
    Mask mirror(m.nx, m.ny);
    mirror.cells = samples::mirrored(m.cells, m.nx, m.ny);
    EXPECT_EQ(transformed(mirror).squared, samples::mirrored(squared, m.nx, m.ny));
  }
}

TEST(DistanceTransform, DoesNotDependOnTheNumberOfThreads) {
  Random random(34);
  const Mask m = samples::speckled(random, 1500, 300, 0.001);
  const Distances one = samples::on_threads(1, [&] { return transformed(m); });
  EXPECT_EQ(one, samples::on_threads(2, [&] { return transformed(m); }));
  EXPECT_EQ(one, samples::on_threads(5, [&] { return transformed(m); }));
}

TEST(DistanceTransform, RefusesSizesThatDoNotFit) {
  const Mask m(4, 3);
  std::vector<std::int32_t> squared(12), short_squared(11);
  std::vector<std::uint32_t> long_nearest(13);
  EXPECT_THROW(distance_transform(m.cells, 4, 4, {squared, {}}), PreconditionViolation);
  EXPECT_THROW(distance_transform(m.cells, 4, 3, {short_squared, {}}), PreconditionViolation);
  EXPECT_THROW(distance_transform(m.cells, 4, 3, {{}, long_nearest}), PreconditionViolation);
  EXPECT_THROW(distance_transform(m.cells, -4, -3, {squared, {}}), PreconditionViolation);
  const Mask wide(largest_distance_side + 1, 1);
  EXPECT_THROW(distance_transform(wide.cells, wide.nx, wide.ny, {}), PreconditionViolation);
  EXPECT_NO_THROW(distance_transform({}, 0, 5, {}));
}

}  // namespace
}  // namespace fairway
