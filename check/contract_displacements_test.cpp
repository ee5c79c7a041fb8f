#include "check/contract_displacements.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace fairway_check {
namespace {

using std::numbers::pi;

/// By how much a point lies outside a polygon with corners counterclockwise.
double outside_by(const Shape& shape, Point p) {
  double most = 0.0;
  const auto corners = shape.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point a = corners[i];
    const Point along = corners[(i + 1) % corners.size()] - a;
    most = std::max(most, -cross(along, p - a) / std::hypot(along.x, along.y));
  }
  return most;
}

/// Where a vehicle is after `share` of a step, its radius one of two at random, for pieces of 1/64.
Point flown(int turn, double clock, double step, double share, double least, double most,
            std::mt19937_64& random) {
  Point at{0.0, 0.0};
  const double piece = step * share / 64.0;
  const std::uint64_t wide = random();
  for (int i = 0; i < 64; ++i) {
    const double from = turn * (clock + i * piece);
    const double to = turn * (clock + (i + 1) * piece);
    const double r = turn * ((wide >> i & 1U) != 0 ? most : least);
    at = at + Point{r * (std::sin(to) - std::sin(from)), r * (std::cos(from) - std::cos(to))};
  }
  return at;
}

TEST(Displacements, HoldEveryArcOfTheLeastRadiusBetweenItsEnds) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 400; ++i) {
    const int turn = i % 2 == 0 ? 1 : -1;
    const double clock = 0.1 * (i - 200);
    const double step = (i % 3 == 0 ? 2.5 : 0.4) * pi / 180.0;
    const Displacements by(turn, clock, step, 5.0, 5.0);
    for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      EXPECT_LT(outside_by(by.partial, flown(turn, clock, step, share, 5.0, 5.0, random)), 1e-13);
    }
    const Point end = flown(turn, clock, step, 1.0, 5.0, 5.0, random);
    EXPECT_NEAR(by.whole.x, end.x, 1e-13);
    EXPECT_NEAR(by.whole.y, end.y, 1e-13);
    EXPECT_EQ(by.slack.count(), 1);
  }
}

TEST(Displacements, HoldEveryArcThatBeginsWithinTheStep) {
  std::mt19937_64 random(3);
  double beside = 0.0;  // what only `begun` holds
  for (int i = 0; i < 2000; ++i) {
    const int turn = i % 2 == 0 ? 1 : -1;
    const double clock = 0.02 * (i - 1000);
    const double step = 2.5 * pi / 180.0;
    const double least = i % 3 == 0 ? 6.0 : 4.0;
    const Displacements by(turn, clock, step, least, 6.0);
    const double from = static_cast<double>(random() >> 11) * 0x1p-53;
    const double share = (1.0 - from) * static_cast<double>(random() >> 11) * 0x1p-53;
    const Point place = flown(turn, clock + from * step, step, share, least, 6.0, random);
    EXPECT_LT(outside_by(by.begun, place), 1e-13);
    beside = std::max(beside, outside_by(by.partial, place));
  }
  EXPECT_GT(beside, 1e-4);
}

TEST(Displacements, HoldEveryWayToVaryTheRadius) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 2000; ++i) {
    const int turn = i % 2 == 0 ? 1 : -1;
    const double clock = 0.02 * (i - 1000);
    const double step = 2.5 * pi / 180.0;
    const Displacements by(turn, clock, step, 4.0, 6.0);
    const double share = static_cast<double>(random() >> 11) * 0x1p-53;
    EXPECT_LT(outside_by(by.partial, flown(turn, clock, step, share, 4.0, 6.0, random)), 1e-13);
    const Point end = flown(turn, clock, step, 1.0, 4.0, 6.0, random);
    EXPECT_LT(outside_by(by.slack, end - by.whole), 1e-13);
  }
}

}  // namespace
}  // namespace fairway_check
