#include "check/interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "fairway/base/random.hpp"

namespace fairway_check {
namespace {

using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<300>>;

bool holds(const Real& a, const Exact& exact) {
  return Exact(a.lower()) <= exact && exact <= Exact(a.upper());
}
/// At most a few rounding errors wide.
bool is_tight(const Real& a) {
  return a.upper() - a.lower() <= 1e-15 * std::max(std::abs(a.lower()), std::abs(a.upper()));
}

double draw(fairway::Random& random) {
  const double size = std::exp(random.uniform(-40.0, 40.0));
  return random.below(2) == 0 ? size : -size;
}

TEST(CheckInterval, EveryOperationHoldsTheExactResultAndLittleElse) {
  fairway::Random random = fairway::Random::stream(1, 1);
  for (int i = 0; i < 20000; ++i) {
    const double a = draw(random);
    const double b = random.below(4) == 0 ? a * (1.0 + 1e-15) : draw(random);
    Real sum, difference, product, quotient, square_root;
    {
      const Upwards upwards;
      sum = Real(a) + b;
      difference = Real(a) - b;
      product = Real(a) * b;
      quotient = Real(a) / b;
      square_root = root(Real(std::abs(a)));
    }
    ASSERT_TRUE(holds(sum, Exact(a) + Exact(b))) << a << " " << b;
    ASSERT_TRUE(holds(difference, Exact(a) - Exact(b))) << a << " " << b;
    ASSERT_TRUE(holds(product, Exact(a) * Exact(b))) << a << " " << b;
    ASSERT_TRUE(holds(quotient, Exact(a) / Exact(b))) << a << " " << b;
    ASSERT_TRUE(holds(square_root, sqrt(Exact(std::abs(a))))) << a;
    ASSERT_TRUE(is_tight(product) && is_tight(quotient) && is_tight(square_root)) << a << " " << b;
  }
}

TEST(CheckInterval, DirectionsOfCommandsAreEnclosedAndEastIsExact) {
  fairway::Random random = fairway::Random::stream(1, 2);
  for (int i = 0; i < 2000; ++i) {
    const auto command = static_cast<float>(random.uniform(-3.1415, 3.1415));
    const Vec u = unit_vector(static_cast<double>(command));
    ASSERT_TRUE(holds(u.x, cos(Exact(command))) && holds(u.y, sin(Exact(command)))) << command;
    ASSERT_TRUE(is_tight(u.x) && is_tight(u.y)) << command;
  }
  const Vec east = unit_vector(0.0);
  EXPECT_TRUE(east.x.lower() == 1.0 && east.x.upper() == 1.0 && is_zero(east.y));
}

TEST(CheckInterval, TheRoundingModeIsRestoredAfterwards) {
  const int before = std::fegetround();
  {
    const Upwards upwards;
    EXPECT_EQ(std::fegetround(), FE_UPWARD);
  }
  EXPECT_EQ(std::fegetround(), before);
}

TEST(CheckInterval, FramesTurnByRightAnglesAndBack) {
  const Vec v{Real(3.0), Real(4.0)};
  const double expected_x[4]{3.0, 4.0, -3.0, -4.0};
  const double expected_y[4]{4.0, -3.0, -4.0, 3.0};
  for (int side = 0; side < 4; ++side) {
    const Vec in = into_frame(side, v);
    EXPECT_EQ(in.x.lower(), expected_x[side]);
    EXPECT_EQ(in.y.lower(), expected_y[side]);
    const Vec out = from_frame(side, in);
    EXPECT_EQ(out.x.lower(), 3.0);
    EXPECT_EQ(out.y.lower(), 4.0);
  }
}

}  // namespace
}  // namespace fairway_check
