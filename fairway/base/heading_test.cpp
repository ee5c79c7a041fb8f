#include "fairway/base/heading.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

// Angles where wrapping is most likely to go wrong, and random ones around them.
std::vector<double> angles() {
  std::vector<double> all;
  for (const double a : {0.0, pi / 2, pi, two_pi, 3 * pi, 100 * pi, 1e-8, 1e-300}) {
    for (const double s : {1.0, -1.0}) {
      all.push_back(s * a);
      all.push_back(std::nextafter(s * a, 10.0));
      all.push_back(std::nextafter(s * a, -10.0));
      all.push_back(s * a + 1e-8);
    }
  }
  Random random(1);
  for (int i = 0; i < 200; ++i) all.push_back(random.uniform(-20.0, 20.0));
  return all;
}

TEST(HeadingOnTheCircle, StaysInTheHalfOpenIntervalAndKeepsItsDirection) {
  for (const double a : angles()) {
    const double h = Heading::from_rad(a).rad();
    EXPECT_GT(h, -pi) << a;
    EXPECT_LE(h, pi) << a;
    EXPECT_NEAR(std::cos(h), std::cos(a), 1e-13 * (1 + std::abs(a))) << a;
    EXPECT_NEAR(std::sin(h), std::sin(a), 1e-13 * (1 + std::abs(a))) << a;
  }
  EXPECT_EQ(Heading::from_rad(-pi).rad(), pi);
  EXPECT_EQ(Heading::of({-1.0, -0.0}).rad(), pi);
}

TEST(HeadingOnTheCircle, TheSmallerTurnLeadsToTheTarget) {
  for (const double a : angles()) {
    for (const double b : angles()) {
      const Heading from = Heading::from_rad(a);
      const Heading to = Heading::from_rad(b);
      const double turn = from.turn_to(to);
      EXPECT_GT(turn, -pi);
      EXPECT_LE(turn, pi);
      EXPECT_NEAR(std::cos(from.rad() + turn), std::cos(to.rad()), 1e-12);
      EXPECT_NEAR(std::sin(from.rad() + turn), std::sin(to.rad()), 1e-12);
    }
  }
}

TEST(HeadingOnTheCircle, ExactlyOppositeTurnsLeft) {
  EXPECT_EQ(Heading::from_rad(0.0).turn_to(Heading::from_rad(pi)), pi);
  EXPECT_EQ(Heading::from_rad(pi).turn_to(Heading::from_rad(0.0)), pi);
  EXPECT_EQ(Heading::from_rad(pi / 2).turn_to(Heading::from_rad(-pi / 2)), pi);
  EXPECT_EQ(Heading::from_rad(-pi / 2).turn_to(Heading::from_rad(pi / 2)), pi);
}

TEST(HeadingOnTheCircle, StoredFloatsLieInTheIntervalAsRealNumbers) {
  for (const double a : angles()) {
    const double stored = Heading::stored(a);
    EXPECT_GT(stored, -pi) << a;
    EXPECT_LE(stored, pi) << a;
    EXPECT_NEAR(std::abs(Heading::from_rad(stored).turn_to(Heading::from_rad(a))), 0.0, 2.5e-7);
  }
  EXPECT_GT(static_cast<double>(std::nextafter(Heading::stored(pi), 4.0F)), pi);
}

TEST(HeadingOnTheCircle, OppositeTwiceIsTheSameDirection) {
  for (const double a : angles()) {
    const Heading h = Heading::from_rad(a);
    EXPECT_NEAR(h.opposite().opposite().turn_to(h), 0.0, 1e-15) << a;
    EXPECT_NEAR(std::abs(h.turn_to(h.opposite())), pi, 1e-15) << a;
  }
}

}  // namespace
}  // namespace fairway
