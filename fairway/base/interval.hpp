// Intervals of reals with ends in double, rounded outwards: the arithmetic under every proof.
//
// Properties that always hold, for finite operands whose exact results stay below 1e300:
//   1. Inclusion: x in X and y in Y imply x op y in X op Y, for the exact reals x, y.
//   2. The processor's rounding mode only has to be to nearest, and is never changed.
// Error bound (derived): to nearest, an operation errs by at most ulp(x) / 2 of its result x, plus
// 2^-1075 when a product or quotient underflows. |x| 2^-52 is at least ulp(x), and exact except for
// underflow; x - ulp(x) is a double; rounding is monotone: so below(x) <= x - ulp(x), which is
// below the exact result. Where x underflows, 2^-1000 alone is more than the error.
// Only standard headers, no heap, no exceptions: runtime.hpp carries it into vehicles.
#pragma once

#include <algorithm>
#include <cmath>

namespace fairway {

/// These few instructions are the inner loop of every proof.
#define FAIRWAY_INLINE [[gnu::always_inline]] inline

struct Interval {
  double lo = 0.0;
  double hi = 0.0;

  constexpr Interval() = default;
  constexpr Interval(double x) : lo(x), hi(x) {}  // NOLINT: a number is an interval
  constexpr Interval(double lo_, double hi_) : lo(lo_), hi(hi_) {}

  constexpr bool empty() const { return !(lo <= hi); }
  constexpr bool contains(double x) const { return lo <= x && x <= hi; }
  constexpr double width() const { return hi - lo; }
  /// Whether the sign is certain.
  constexpr bool positive() const { return lo > 0.0; }
  constexpr bool negative() const { return hi < 0.0; }
};

/// One step of the error bound above, downwards and upwards.
FAIRWAY_INLINE double below(double x) { return x - (std::abs(x) * 0x1p-52 + 0x1p-1000); }
FAIRWAY_INLINE double above(double x) { return x + (std::abs(x) * 0x1p-52 + 0x1p-1000); }
FAIRWAY_INLINE Interval outward(double lo, double hi) { return {below(lo), above(hi)}; }

FAIRWAY_INLINE Interval operator-(Interval a) { return {-a.hi, -a.lo}; }
FAIRWAY_INLINE Interval operator+(Interval a, Interval b) {
  return outward(a.lo + b.lo, a.hi + b.hi);
}
FAIRWAY_INLINE Interval operator-(Interval a, Interval b) {
  return outward(a.lo - b.hi, a.hi - b.lo);
}
FAIRWAY_INLINE Interval operator*(Interval a, Interval b) {
  const double p = a.lo * b.lo;
  const double q = a.lo * b.hi;
  const double s = a.hi * b.lo;
  const double t = a.hi * b.hi;
  return outward(std::min(std::min(p, q), std::min(s, t)),
                 std::max(std::max(p, q), std::max(s, t)));
}
/// `a` or its mirror image: exact.
FAIRWAY_INLINE Interval with_sign(double sign, Interval a) { return sign > 0.0 ? a : -a; }
FAIRWAY_INLINE Interval operator*(double k, Interval a) {
  const double p = k * a.lo;
  const double q = k * a.hi;
  return outward(std::min(p, q), std::max(p, q));
}
/// `k` > 0.
FAIRWAY_INLINE Interval operator/(Interval a, double k) { return outward(a.lo / k, a.hi / k); }
/// `b` has a certain sign.
FAIRWAY_INLINE Interval operator/(Interval a, Interval b) {
  const double p = a.lo / b.lo;
  const double q = a.lo / b.hi;
  const double s = a.hi / b.lo;
  const double t = a.hi / b.hi;
  return outward(std::min(std::min(p, q), std::min(s, t)),
                 std::max(std::max(p, q), std::max(s, t)));
}

FAIRWAY_INLINE Interval square(Interval a) {
  const double p = a.lo * a.lo;
  const double q = a.hi * a.hi;
  const double least = a.lo <= 0.0 && a.hi >= 0.0 ? 0.0 : below(std::min(p, q));
  return {std::max(0.0, least), above(std::max(p, q))};
}
/// Of the non-negative part of `a`; `a.hi` >= 0.
FAIRWAY_INLINE Interval sqrt(Interval a) {
  const double low = a.lo > 0.0 ? below(std::sqrt(a.lo)) : 0.0;
  return {std::max(0.0, low), above(std::sqrt(a.hi))};
}

constexpr Interval intersection(Interval a, Interval b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}
constexpr Interval hull(Interval a, Interval b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

/// A box in the plane; a set of unit vectors when it stands for headings.
struct IntervalVec2 {
  Interval x;
  Interval y;

  friend IntervalVec2 operator+(IntervalVec2 a, IntervalVec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend IntervalVec2 operator-(IntervalVec2 a, IntervalVec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend IntervalVec2 operator-(IntervalVec2 a) { return {-a.x, -a.y}; }
};
FAIRWAY_INLINE Interval dot(const IntervalVec2& a, const IntervalVec2& b) {
  return a.x * b.x + a.y * b.y;
}
FAIRWAY_INLINE Interval cross(const IntervalVec2& a, const IntervalVec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// Cosine and sine of `rad`, |rad| <= pi. Assumes the C library's cos and sin err by less than
/// four units in the last place (glibc documents one); docs/trust.md lists the assumption. The
/// doubles 0, +-pi/2 and pi stand for the axes: the true axis and the double's own direction both
/// lie inside.
inline IntervalVec2 unit_enclosure(double rad) {
  if (rad == 0.0) return {{1.0, 1.0}, {0.0, 0.0}};
  const double c = std::cos(rad);
  const double s = std::sin(rad);
  const double ec = std::abs(c) * 0x1p-50;
  const double es = std::abs(s) * 0x1p-50;
  IntervalVec2 u{{std::max(-1.0, c - ec), std::min(1.0, c + ec)},
                 {std::max(-1.0, s - es), std::min(1.0, s + es)}};
  if (std::abs(c) < 1e-16) u.x = hull(u.x, 0.0);
  if (std::abs(s) < 2e-16) u.y = hull(u.y, 0.0);
  return u;
}

#undef FAIRWAY_INLINE

}  // namespace fairway
