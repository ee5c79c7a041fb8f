// For tests: the six words by the textbook, in long double and with the C library's functions.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "fairway/base/random.hpp"
#include "fairway/steer/dubins_words.hpp"

namespace fairway::oracle {

using Real = long double;
inline const Real circle = 2.0L * std::acos(-1.0L);

/// [0, 2 pi); `slack` below a whole turn counts as none.
inline Real wrapped(Real a, Real slack) {
  a = std::fmod(a, circle);
  if (a < 0.0L) a += circle;
  return a >= circle - slack ? 0.0L : a;
}

/// Lengths of LSL RSR LSR RSL RLR LRL for r = 1, infinity where there is none. In the frame of
/// Shkel and Lumelsky (2001): both poses on the x axis, `d` apart, headings `a` and `b`.
inline std::array<Real, 6> lengths(Real d, Real a, Real b, Real slack) {
  const Real none = std::numeric_limits<Real>::infinity();
  const Real sa = std::sin(a), sb = std::sin(b), ca = std::cos(a), cb = std::cos(b);
  const Real c = std::cos(a - b);
  const auto mod = [&](Real x) { return wrapped(x, slack); };
  std::array<Real, 6> of;
  of.fill(none);
  const auto root = [](Real x) { return x < 0.0L && x > -1e-16L ? 0.0L : std::sqrt(x); };
  Real x = ca - cb, y = d + sa - sb;  // LSL: legs of the line between left centres
  Real at = x == 0.0L && y == 0.0L ? a : std::atan2(-(ca - cb), y);
  of[0] = mod(at - a) + std::hypot(x, y) + mod(b - at);
  y = d - sa + sb;
  at = x == 0.0L && y == 0.0L ? a : std::atan2(ca - cb, y);
  of[1] = mod(a - at) + std::hypot(x, y) + mod(at - b);
  Real p = root(d * d - 2.0L + 2.0L * c + 2.0L * d * (sa + sb));
  if (p >= 0.0L) {
    at = std::atan2(-ca - cb, d + sa + sb) - std::atan2(-2.0L, p);
    of[2] = mod(at - a) + p + mod(at - b);
  }
  p = root(d * d - 2.0L + 2.0L * c - 2.0L * d * (sa + sb));
  if (p >= 0.0L) {
    at = std::atan2(ca + cb, d - sa - sb) - std::atan2(2.0L, p);
    of[3] = mod(a - at) + p + mod(b - at);
  }
  const auto three = [&](Real sign) {
    const Real between = std::hypot(ca - cb, d - sign * (sa - sb));  // outer centres
    if (between > 4.0L) return none;
    // Near 4 an arc cosine keeps what an arc sine loses, near 0 the other way round.
    const Real gap = std::sqrt((4.0L - between) * (4.0L + between));
    const Real middle = circle - 2.0L * std::atan2(between, gap);
    const Real first = sign * a - std::atan2(ca - cb, d - sign * (sa - sb)) + middle / 2.0L;
    return mod(first) + middle + mod(sign * (a - b) - mod(first) + middle);
  };
  of[4] = three(1.0L);
  of[5] = three(-1.0L);
  return of;
}

inline std::array<Real, 6> lengths(const State& from, const State& to, double r, Real slack) {
  const Real dx = (static_cast<Real>(to.position_m.x) - from.position_m.x) / r;
  const Real dy = (static_cast<Real>(to.position_m.y) - from.position_m.y) / r;
  const Real theta = dx == 0.0L && dy == 0.0L ? 0.0L : std::atan2(dy, dx);
  return lengths(std::hypot(dx, dy), from.heading.rad() - theta, to.heading.rad() - theta, slack);
}

inline Real least(const std::array<Real, 6>& all) {
  Real best = all[0];
  for (const Real x : all) best = std::min(best, x);
  return best;
}

/// Poses in a box of `size` by `size`, any heading.
inline State random_pose(Random& random, double size) {
  const Vec2 p{random.uniform(0.0, size), random.uniform(0.0, size)};
  return {p, Heading::from_rad(random.uniform(-pi, pi))};
}

}  // namespace fairway::oracle
