#include "fairway/base/interval.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

using Rational = boost::multiprecision::cpp_rational;
namespace mp = boost::multiprecision;
using Wide = mp::number<mp::cpp_bin_float<400, mp::digit_base_2>>;

constexpr double pi = std::numbers::pi;

/// A number, with powers of two, their neighbours, zeros and tiny ones on purpose.
double number(Random& random) {
  static constexpr std::array<double, 10> special{
      0.0, -0.0, 1.0, -1.0, 0x1p-1074, -0x1p-1060, 0x1p-530, -0x1p-540, 1e100, 1.0 / 3.0};
  switch (random.below(5)) {
    case 0:
      return special[random.below(special.size())];
    case 1: {  // a power of two or a neighbour of one
      const double power = std::ldexp(1.0, static_cast<int>(random.below(120)) - 60);
      const double to = random.below(2) == 0 ? 0.0 : 1e300;
      const double x = random.below(3) == 0 ? power : std::nextafter(power, to);
      return random.below(2) == 0 ? x : -x;
    }
    case 2:
      return random.uniform(-1.0, 1.0);
    default:
      return random.normal() * std::exp2(random.uniform(-40.0, 40.0));
  }
}

Interval interval(Random& random) {
  const double a = number(random);
  if (random.below(3) == 0) return {a, a};
  if (random.below(3) == 0) {
    return {a, std::nextafter(a, std::numeric_limits<double>::infinity())};
  }
  const double b = number(random);
  return {std::min(a, b), std::max(a, b)};
}

/// A member: an end, the midpoint, or another one.
double member(Random& random, Interval x) {
  switch (random.below(4)) {
    case 0:
      return x.lo;
    case 1:
      return x.hi;
    default:
      return std::min(std::max(x.lo, x.lo + random.unit() * (x.hi - x.lo)), x.hi);
  }
}

bool holds(Interval x, const Rational& exact) {
  return Rational(x.lo) <= exact && exact <= Rational(x.hi);
}

/// For a result from operands without width: at most four steps of its size wide.
bool is_tight(Interval x) {
  return x.width() <= 4.0 * (std::max(std::abs(x.lo), std::abs(x.hi)) * 0x1p-52 + 0x1p-1000);
}

TEST(Interval, HoldsTheExactSumDifferenceProductAndQuotientOfMembers) {
  Random random(1);
  for (int i = 0; i < 40000; ++i) {
    const Interval a = interval(random);
    const Interval b = interval(random);
    const double x = member(random, a);
    const double y = member(random, b);
    const Rational p(x);
    const Rational q(y);
    ASSERT_TRUE(holds(a + b, p + q)) << x << " + " << y;
    ASSERT_TRUE(holds(a - b, p - q)) << x << " - " << y;
    ASSERT_TRUE(holds(a * b, p * q)) << x << " * " << y;
    ASSERT_TRUE(holds(x * b, p * q)) << x << " * (number) " << y;
    ASSERT_TRUE(holds(-a, -p)) << x;
    if (b.positive() || b.negative()) {
      // Within the limit stated in interval.hpp: exact results below 1e300.
      const double least = std::min(std::abs(b.lo), std::abs(b.hi));
      const double largest = std::max(std::abs(a.lo), std::abs(a.hi));
      if (largest > least * 1e290) continue;
      ASSERT_TRUE(holds(a / b, p / q)) << x << " / " << y;
    }
  }
}

TEST(Interval, IsNoWiderThanItsErrorBound) {
  Random random(2);
  for (int i = 0; i < 10000; ++i) {
    const Interval a(number(random));
    const Interval b(number(random));
    ASSERT_TRUE(is_tight(a + b));
    ASSERT_TRUE(is_tight(a * b));
    ASSERT_TRUE(is_tight(square(a)));
    if (b.lo != 0.0 && std::abs(a.lo) < std::abs(b.lo) * 1e290) {
      ASSERT_TRUE(is_tight(a / b));
    }
    if (a.lo >= 0.0) {
      ASSERT_TRUE(is_tight(sqrt(a)));
    }
  }
}

TEST(Interval, HoldsExactSquaresAndRoots) {
  Random random(3);
  for (int i = 0; i < 40000; ++i) {
    const Interval a = interval(random);
    const double x = member(random, a);
    ASSERT_TRUE(holds(square(a), Rational(x) * Rational(x))) << x;
    ASSERT_GE(square(a).lo, 0.0);
    if (x < 0.0) continue;
    const Interval root = sqrt(a);
    ASSERT_GE(root.lo, 0.0);
    ASSERT_LE(Rational(root.lo) * Rational(root.lo), Rational(x)) << x;
    ASSERT_GE(Rational(root.hi) * Rational(root.hi), Rational(x)) << x;
  }
}

TEST(Interval, MovesADoubleByMoreThanItsRounding) {
  Random random(4);
  for (int i = 0; i < 40000; ++i) {
    const double x = number(random);
    // Any exact number that rounds to x lies between its neighbours.
    ASSERT_LE(below(x), std::nextafter(x, -1e308));
    ASSERT_GE(above(x), std::nextafter(x, 1e308));
  }
}

TEST(Interval, SaysASignIsCertainOnlyWhenItIs) {
  EXPECT_FALSE(Interval(0.0).positive());
  EXPECT_FALSE(Interval(0.0).negative());
  EXPECT_FALSE(Interval(-0.0, 0x1p-1074).positive());
  EXPECT_TRUE(Interval(0x1p-1074, 1.0).positive());
  EXPECT_TRUE(Interval(-1.0, -0x1p-1074).negative());
  EXPECT_TRUE(Interval(1.0, 0.0).empty());
  EXPECT_TRUE(Interval(std::nan(""), 0.0).empty());
  EXPECT_FALSE(Interval(0.0).empty());
}

void expect_unit(double rad) {
  const IntervalVec2 u = unit_enclosure(rad);
  const Wide c = cos(Wide(rad));
  const Wide s = sin(Wide(rad));
  ASSERT_TRUE(Wide(u.x.lo) <= c && c <= Wide(u.x.hi)) << rad;
  ASSERT_TRUE(Wide(u.y.lo) <= s && s <= Wide(u.y.hi)) << rad;
  ASSERT_LE(u.x.width(), 2e-15) << rad;
  ASSERT_LE(u.y.width(), 2e-15) << rad;
}

TEST(Interval, HoldsSinesAndCosinesOfAnyHeading) {
  Random random(5);
  for (const double axis : {0.0, pi / 4, pi / 2, 3 * pi / 4, pi, 0x1p-1, 0x1p-30, 1e-300}) {
    for (const double rad : {axis, -axis}) {
      expect_unit(rad);
      expect_unit(std::nextafter(rad, 4.0));
      expect_unit(std::nextafter(rad, -4.0));
      expect_unit(static_cast<double>(static_cast<float>(rad)));
      if (std::abs(rad) < 3.1) expect_unit(rad + 1e-8);
    }
  }
  for (int i = 0; i < 2000; ++i) {
    expect_unit(random.uniform(-pi, pi));
    expect_unit(static_cast<double>(static_cast<float>(random.uniform(-pi, pi))));
    expect_unit(std::exp2(random.uniform(-60.0, 0.0)));
  }
}

TEST(Interval, TakesTheDoublesNearestToTheAxesForTheAxesToo) {
  EXPECT_TRUE(unit_enclosure(pi / 2).x.contains(0.0));
  EXPECT_TRUE(unit_enclosure(-pi / 2).x.contains(0.0));
  EXPECT_TRUE(unit_enclosure(pi).y.contains(0.0));
  EXPECT_EQ(unit_enclosure(0.0).y.lo, 0.0);
  EXPECT_EQ(unit_enclosure(0.0).y.hi, 0.0);
  // A float is not one of them, nor is a double's neighbour.
  EXPECT_TRUE(unit_enclosure(static_cast<double>(1.57079637F)).x.negative());
  EXPECT_TRUE(unit_enclosure(std::nextafter(pi / 2, 0.0)).x.positive());
}

TEST(Interval, CrossesAndDotsSetsOfVectors) {
  Random random(6);
  for (int i = 0; i < 20000; ++i) {
    const IntervalVec2 a{interval(random), interval(random)};
    const IntervalVec2 b{interval(random), interval(random)};
    const Rational ax(member(random, a.x));
    const Rational ay(member(random, a.y));
    const Rational bx(member(random, b.x));
    const Rational by(member(random, b.y));
    ASSERT_TRUE(holds(cross(a, b), ax * by - ay * bx));
    ASSERT_TRUE(holds(dot(a, b), ax * bx + ay * by));
  }
}

}  // namespace
}  // namespace fairway
