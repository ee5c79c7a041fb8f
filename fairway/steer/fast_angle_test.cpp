#include "fairway/steer/fast_angle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

TEST(FastAngle, UnitVectorsAreThoseOfLongDouble) {
  Random random(1);
  long double worst = 0.0L;
  const auto look = [&](double h) {
    const Vec2 u = fast_unit(h);
    worst = std::max({worst, std::abs(u.x - std::cos(static_cast<long double>(h))),
                      std::abs(u.y - std::sin(static_cast<long double>(h)))});
  };
  for (int i = 0; i < 500'000; ++i) look(random.uniform(-7.0, 7.0));
  for (int k = -8; k <= 8; ++k) {  // the axes, the seams between quarters, and next to them
    for (const double off : {0.0, 1e-16, -1e-16, 1e-12, -1e-12, 1e-8, -1e-8}) {
      look(k * (pi / 4) + off);
    }
  }
  EXPECT_LE(worst, 2.0e-16L);
}

TEST(FastAngle, AnglesAreThoseOfLongDouble) {
  Random random(2);
  long double worst = 0.0L;
  const auto look = [&](Vec2 v) {
    const long double exact =
        std::atan2(static_cast<long double>(v.y), static_cast<long double>(v.x));
    worst = std::max(worst, std::abs(signed_angle(v) - exact));
    const long double turn = exact < 0.0L ? exact + 2.0L * std::acos(-1.0L) : exact;
    worst = std::max(worst, std::abs(left_turn_to(v) - turn));
  };
  for (int i = 0; i < 500'000; ++i) {
    look({random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)});
    const double scale = std::pow(10.0, random.uniform(-20.0, 20.0));
    look({random.uniform(-1.0, 1.0), scale * random.uniform(-1.0, 1.0)});
  }
  for (const double x : {0.0, 1.0, -1.0, 0x1p-300, -0x1p-300, 0x1p300, 0.41421356237309503}) {
    for (const double y : {0.0, 1.0, -1.0, 0x1p-300, -0x1p-300, 0x1p300, -0.41421356237309503}) {
      if (x != 0.0 || y != 0.0) look({x, y});
    }
  }
  EXPECT_LE(worst, 1.0e-15L);
  EXPECT_EQ(left_turn_to({0.0, 0.0}), 0.0);
}

}  // namespace
}  // namespace fairway
