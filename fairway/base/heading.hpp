// A direction on the circle, radians counter-clockwise from +x (east), held in (-pi, pi].
//
// Only this file wraps angles. Properties that always hold:
//   1. -pi < Heading::rad() <= pi, in double arithmetic (M_PI is the double nearest to pi).
//   2. turn_to() is in (-pi, pi]; for exactly opposite headings it is +pi: a simulation turns left.
//   3. stored() is a float in (-pi, pi] as a real number: the floats next to +-pi lie outside the
//      interval, so the last representable one inside is used (1.5e-7 rad away).
#pragma once

#include <cmath>
#include <numbers>

#include "fairway/base/vec2.hpp"

namespace fairway {

inline constexpr double pi = std::numbers::pi;
inline constexpr double two_pi = 2.0 * std::numbers::pi;

class Heading {
 public:
  constexpr Heading() = default;

  /// Any finite angle; one reduction by std::remainder, exact in floating point.
  static Heading from_rad(double angle_rad) {
    if (angle_rad > -pi && angle_rad <= pi) return Heading(angle_rad);
    const double r = std::remainder(angle_rad, two_pi);
    return Heading(r <= -pi ? pi : r);
  }

  /// Direction of a vector that is not zero.
  static Heading of(Vec2 direction) {
    const double a = std::atan2(direction.y, direction.x);
    return Heading(a <= -pi ? pi : a);
  }

  constexpr double rad() const { return rad_; }
  Vec2 unit() const { return {std::cos(rad_), std::sin(rad_)}; }
  Heading opposite() const { return from_rad(rad_ > 0.0 ? rad_ - pi : rad_ + pi); }

  /// The smaller signed turn from this heading to `target`, (-pi, pi], positive to the left.
  double turn_to(Heading target) const { return wrapped_difference(target.rad_ - rad_); }

  /// The value kept in a plan file, see property 3.
  static float stored(double angle_rad) {
    constexpr float largest = 3.1415925F;  // the float below pi
    const auto f = static_cast<float>(from_rad(angle_rad).rad());
    if (f > largest) return largest;
    if (f < -largest) return -largest;
    return f;
  }

  friend constexpr bool operator==(Heading, Heading) = default;

 private:
  explicit constexpr Heading(double rad) : rad_(rad) {}

  static constexpr double wrapped_difference(double d) {  // |d| < 2 pi
    if (d > pi) return d - two_pi;
    if (d <= -pi) return d + two_pi;
    return d;
  }

  double rad_ = 0.0;
};

}  // namespace fairway
