// An oracle for tests: the exact motion through one cell in a wide number type, from docs/model.md
// alone. It shares no geometry with the code under test: every candidate event is a point of the
// circle, ordered by the tangent of half the angle turned.
//
// `Real` is boost::multiprecision::cpp_bin_float_oct where a proof is attacked (237 bits: near a
// touch half of them are lost), long double where a second opinion is enough.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstddef>

#include "fairway/vehicle/side.hpp"

namespace fairway {

using Wide = boost::multiprecision::cpp_bin_float_oct;

template <typename Real>
struct WideVec {
  Real x;
  Real y;

  friend WideVec operator+(const WideVec& a, const WideVec& b) { return {a.x + b.x, a.y + b.y}; }
  friend WideVec operator-(const WideVec& a, const WideVec& b) { return {a.x - b.x, a.y - b.y}; }
  friend WideVec operator*(const Real& k, const WideVec& a) { return {k * a.x, k * a.y}; }
};
template <typename Real>
Real wide_dot(const WideVec<Real>& a, const WideVec<Real>& b) {
  return a.x * b.x + a.y * b.y;
}
template <typename Real>
Real wide_cross(const WideVec<Real>& a, const WideVec<Real>& b) {
  return a.x * b.y - a.y * b.x;
}
template <typename Real>
WideVec<Real> wide_left(const WideVec<Real>& a) {
  return {-a.y, a.x};
}
/// The direction of an angle as given; the doubles nearest to the axes stand for the axes.
template <typename Real>
WideVec<Real> wide_unit(double rad) {
  using std::cos;
  using std::sin;
  constexpr double half_turn = 3.14159265358979323846;
  if (rad == half_turn) return {Real(-1), Real(0)};
  if (rad == half_turn / 2) return {Real(0), Real(1)};
  if (rad == -half_turn / 2) return {Real(0), Real(-1)};
  return {cos(Real(rad)), sin(Real(rad))};
}

template <typename Real>
struct WideExit {
  Side side = Side::right;
  WideVec<Real> p;  ///< on the side, in the coordinates of the cell that is left
  WideVec<Real> u;
  bool aligned = false;    ///< left straight, with the command for its heading
  int turn = 0;            ///< of the arc on which the cell was left
  WideVec<Real> centre;    ///< of that arc
  long double length = 0;  /// flown in the cell
};

/// The first exit, and those that cannot be distinguished from it: less than `tie` apart (in
/// tangents of half angles, or in cell_m).
template <typename Real>
struct WideExits {
  std::array<WideExit<Real>, 8> of;
  std::size_t count = 0;

  void add(const WideExit<Real>& exit) {
    if (count < of.size()) of[count++] = exit;
  }
  const WideExit<Real>& first() const { return of[0]; }
};

template <typename Real>
class WideCell {
 public:
  WideCell(double cell_m, double turn_radius_m) : d_(cell_m), r_(turn_radius_m) {}

  static Real tie() { return Real(1e-26); }

  /// Straight on from p.
  void straight(const WideVec<Real>& p, const WideVec<Real>& u, WideExit<Real> exit,
                WideExits<Real>& exits) const {
    std::array<Real, 4> gone;
    Real least(1e9 * static_cast<double>(d_));
    for (std::size_t s = 0; s < 4; ++s) {
      const Real speed = outward(u, static_cast<Side>(s));
      gone[s] = speed > 0 ? gap(p, static_cast<Side>(s)) / speed : Real(-1);
      if (speed > 0 && gone[s] < least) least = gone[s];
    }
    const long double before = exit.length;
    for (std::size_t s = 0; s < 4; ++s) {
      if (gone[s] < 0 || gone[s] > least + tie() * d_) continue;
      exit.side = static_cast<Side>(s);
      exit.p = on_side(p + gone[s] * u, exit.side);
      exit.u = u;
      exit.length = before + static_cast<long double>(gone[s]);
      exits.add(exit);
    }
  }

  /// Turning by `turn` (+1, -1) towards `command`.
  WideExits<Real> turning(const WideVec<Real>& p, const WideVec<Real>& u,
                          const WideVec<Real>& command, int turn) const {
    const Real k(turn);
    const WideVec<Real> centre = p + (k * r_) * wide_left(u);
    // Tangent of half the angle from u to w; negative when w lies more than half a turn ahead.
    const auto turned = [&](const WideVec<Real>& w) {
      return k * wide_cross(u, w) / (1 + wide_dot(u, w));
    };
    const Real far(1e9);
    std::array<Real, 4> at{far, far, far, far};
    std::array<WideVec<Real>, 4> where;
    std::array<WideVec<Real>, 4> heading;
    Real least = wide_dot(u, command) < -0.5 ? far : turned(command);
    if (least < 0) least = least > -tie() ? Real(0) : far;
    const Real to_align = least;
    for (std::size_t s = 0; s < 4; ++s) {
      using std::sqrt;
      const Side side = static_cast<Side>(s);
      const bool vertical = s % 2 == 0;
      const Real line = s < 2 ? d_ : Real(0);
      const Real a = (line - (vertical ? centre.x : centre.y)) / r_;
      Real rest = 1 - a * a;
      if (rest < -tie()) continue;
      if (rest < 0) rest = 0;
      const Real b = sqrt(rest);
      for (const int sign : {1, -1}) {
        const WideVec<Real> radius =
            vertical ? WideVec<Real>{a, Real(sign) * b} : WideVec<Real>{Real(sign) * b, a};
        const WideVec<Real> w = k * wide_left(radius);
        if (outward(w, side) < 0) continue;
        if (wide_dot(u, w) < -0.5) continue;
        // A state on the side that heads out leaves at once; one that heads along it, turning in,
        // does not.
        Real t = turned(w);
        if (t < 0 && t > -tie()) t = 0;
        if (t < tie() && outward(w, side) < tie() && outward(k * wide_left(w), side) < 0) continue;
        if (t < 0 || t > at[s]) continue;
        at[s] = t;
        where[s] = on_side(centre + r_ * radius, side);
        heading[s] = w;
        if (t < least) least = t;
      }
    }
    WideExits<Real> exits;
    const auto arc_length = [&](const Real& t) {
      return static_cast<long double>(r_) * 2 * std::atan(static_cast<long double>(t));
    };
    for (std::size_t s = 0; s < 4; ++s) {
      if (at[s] == far || at[s] > least + tie()) continue;
      exits.add(
          {static_cast<Side>(s), where[s], heading[s], false, turn, centre, arc_length(at[s])});
    }
    if (to_align < far && to_align <= least + tie()) {
      WideExit<Real> exit;
      exit.aligned = true;
      exit.length = arc_length(to_align);
      straight(centre - (k * r_) * wide_left(command), command, exit, exits);
    }
    return exits;
  }

  /// The way the model turns: +1 left, -1 right, 0 aligned; 2 both (exactly opposite).
  static int turn_of(const WideVec<Real>& u, const WideVec<Real>& command) {
    const Real side = wide_cross(u, command);
    if (abs(side) < Real(1e-30)) return wide_dot(u, command) > 0 ? 0 : 2;
    return side > 0 ? 1 : -1;
  }

  static Real outward(const WideVec<Real>& v, Side side) {
    return side == Side::right ? v.x : side == Side::top ? v.y : side == Side::left ? -v.x : -v.y;
  }

 private:
  static Real abs(const Real& x) { return x < 0 ? Real(-x) : x; }
  Real gap(const WideVec<Real>& p, Side side) const {
    const Real g = side == Side::right  ? Real(d_ - p.x)
                   : side == Side::top  ? Real(d_ - p.y)
                   : side == Side::left ? p.x
                                        : p.y;
    return g < 0 ? Real(0) : g;
  }
  WideVec<Real> on_side(WideVec<Real> p, Side side) const {
    (side == Side::right || side == Side::left ? p.x : p.y) =
        side == Side::right || side == Side::top ? d_ : Real(0);
    return p;
  }

  Real d_;
  Real r_;
};

}  // namespace fairway
