// Intervals with ends rounded outwards by the processor (Boost.Interval), pairs of them, and
// frames.
//
// All arithmetic on `Real` must run while an `Upwards` is alive in the same thread: the rounding
// mode is then upwards throughout, and a lower end is computed as the negative of an upper one.
#pragma once

#include <cfenv>

#include <boost/numeric/interval.hpp>

namespace fairway_check {

namespace boosts = boost::numeric::interval_lib;
using Rounding = boosts::save_state_nothing<boosts::rounded_arith_opp<double>>;
using Policies = boosts::policies<Rounding, boosts::checking_base<double>>;
using Real = boost::numeric::interval<double, Policies>;

/// Sets the rounding mode of this thread, tests that the arithmetic honours it, and restores it at
/// the end. Throws std::runtime_error when the machine or the compiler does not.
class Upwards {
 public:
  Upwards();
  ~Upwards();
  Upwards(const Upwards&) = delete;
  Upwards& operator=(const Upwards&) = delete;

 private:
  int before_;
};

inline bool positive(const Real& a) { return a.lower() > 0.0; }
inline bool negative(const Real& a) { return a.upper() < 0.0; }
inline bool is_zero(const Real& a) { return a.lower() == 0.0 && a.upper() == 0.0; }
/// Intersects `a` with `b`; false when nothing is left.
inline bool cut(Real& a, const Real& b) {
  const double low = a.lower() > b.lower() ? a.lower() : b.lower();
  const double high = a.upper() < b.upper() ? a.upper() : b.upper();
  if (!(low <= high)) return false;
  a.assign(low, high);
  return true;
}
/// Square root of the non-negative part: x / sqrt(x), with the denominator rounded up, is at most
/// sqrt(x), so the mode need not be changed.
Real root(const Real& a);

/// In the world: east, north. In the frame of a side: outwards across it, and along it, with the
/// outward direction on the right.
struct Vec {
  Real x;
  Real y;
};
inline Real dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y; }
inline Real cross(const Vec& a, const Vec& b) { return a.x * b.y - a.y * b.x; }

/// Sides: 0 right, 1 top, 2 left, 3 bottom; each frame is the previous one turned by 90 degrees.
inline Vec into_frame(int side, const Vec& v) {
  const Vec w = side % 2 == 0 ? v : Vec{v.y, -v.x};
  return side < 2 ? w : Vec{-w.x, -w.y};
}
inline Vec from_frame(int side, const Vec& v) { return into_frame((4 - side) & 3, v); }
constexpr int step_x[4]{1, 0, -1, 0};
constexpr int step_y[4]{0, 1, 0, -1};

/// Cosine and sine of a finite angle, from MPFR; needs no rounding mode. Exact at 0.
Vec unit_vector(double angle_rad);

}  // namespace fairway_check
