// The six words one by one, in units of the turning radius. Private to the Dubins sources.
//
// Everything is in the frame of the world, moved to the start: no rotation is needed. The words
// that begin with a right turn are mirror images of those that begin with a left one.
#pragma once

#include <cmath>
#include <limits>

#include "fairway/base/heading.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/steer/fast_angle.hpp"

namespace fairway::dubins {

/// Two lanes of a register: a pair of poses and its mirror image, or two pairs.
using Two [[gnu::vector_size(16)]] = double;

[[gnu::always_inline]] inline double root(double x) { return std::sqrt(x); }
[[gnu::always_inline]] inline Two root(Two x) { return Two{std::sqrt(x[0]), std::sqrt(x[1])}; }

/// Two poses as the words see them.
template <typename T>
struct Pair {
  Plane<T> u0;  ///< unit vectors of the headings
  Plane<T> u1;
  Plane<T> d;  ///< from start to goal
  T left;      ///< the turn from heading to heading, to the left, [0, 2 pi]
  T right;
  T near;  ///< property 3

  // Between centres: left to left, left to right. The others are their mirror images.
  [[gnu::always_inline]] Plane<T> ll() const { return d + (left_of(u1) - left_of(u0)); }
  [[gnu::always_inline]] Plane<T> lr() const { return d - (left_of(u1) + left_of(u0)); }
};

template <typename T>
[[gnu::always_inline]] inline Plane<T> mirrored(const Plane<T>& v) {
  return {v.x, -v.y};
}
template <typename T>
[[gnu::always_inline]] inline Pair<T> mirrored(const Pair<T>& p) {
  return {mirrored(p.u0), mirrored(p.u1), mirrored(p.d), p.right, p.left, p.near};
}

/// A pair and its mirror image.
[[gnu::always_inline]] inline Pair<Two> both_ways(const Pair<double>& p) {
  const auto both = [](const Plane<double>& v) {
    return Plane<Two>{Two{v.x, v.x}, Two{v.y, -v.y}};
  };
  return {both(p.u0),           both(p.u1),           both(p.d),
          Two{p.left, p.right}, Two{p.right, p.left}, Two{p.near, p.near}};
}

/// The numbers of a pair.
struct Poses {
  double x0_m, y0_m, h0_rad;  ///< headings in (-pi, pi]
  double x1_m, y1_m, h1_rad;
  double turn_radius_m;
};
[[gnu::always_inline]] inline Poses mirrored(const Poses& p) {
  return {p.x0_m, -p.y0_m, -p.h0_rad, p.x1_m, -p.y1_m, -p.h1_rad, p.turn_radius_m};
}

[[gnu::always_inline]] inline Pair<double> pair_of(const Poses& p, const Plane<double>& u0,
                                                   const Plane<double>& u1) {
  const double per_radius = 1.0 / p.turn_radius_m;
  const Plane<double> d{(p.x1_m - p.x0_m) * per_radius, (p.y1_m - p.y0_m) * per_radius};
  const double turn = p.h1_rad - p.h0_rad;
  return {u0,
          u1,
          d,
          turn < 0.0 ? turn + two_pi : turn,
          turn > 0.0 ? two_pi - turn : -turn,
          1e-13 * (1.0 + (std::abs(d.x) + std::abs(d.y)))};
}
[[gnu::always_inline]] inline Pair<double> pair_of(const Poses& p) {
  return pair_of(p, fast_angle::unit(p.h0_rad), fast_angle::unit(p.h1_rad));
}

/// Whether `v` is |v| in a direction that a left turn from u0 to u1 passes, within `near`: in the
/// cone between them, which is convex up to half a turn and the complement of a convex one beyond.
template <typename T>
[[gnu::always_inline]] inline auto is_passed(const Plane<T>& u0, const Plane<T>& u1, const T& left,
                                             const Plane<T>& v, const T& near) {
  const auto after = cross(u0, v) >= -near;
  const auto before = cross(v, u1) >= -near;
  const auto ahead = dot(v, u0 + u1) >= -2.0 * near;
  return ((left > pi) & (after | before)) | (after & before & ahead);
}
template <typename T>
[[gnu::always_inline]] inline auto is_passed(const Pair<T>& p, const Plane<T>& v) {
  return is_passed(p.u0, p.u1, p.left, v, p.near);
}

/// LSL: the turns add up to the turn between the headings, or to a whole turn more.
template <typename T>
[[gnu::always_inline]] inline T lsl_length(const Pair<T>& p) {
  const Plane<T> ll = p.ll();
  const T straight = root(norm2(ll));
  // x - x: zero, for numbers and vectors alike. NOLINTNEXTLINE(misc-redundant-expression)
  return (straight <= p.near ? straight - straight : straight) +
         (is_passed(p, ll) ? p.left : p.left + two_pi);
}

/// LSR exists when the circles are disjoint or touch. p^2 for a straight part p; below 0: none.
template <typename T>
[[gnu::always_inline]] inline T crossing_square(const Pair<T>& p, const Plane<T>& between) {
  const T square = norm2(between) - 4.0;
  // x - x: zero, for numbers and vectors alike. NOLINTNEXTLINE(misc-redundant-expression)
  return ((square < 0.0) & (square >= -4.0 * p.near)) ? square - square : square;
}

/// The first turn of LSR: up to the direction of the straight part, which lies to the left of `lr`
/// by the angle of a right triangle with legs (p, 2).
template <typename T>
[[gnu::always_inline]] inline T lsr_turn(const Pair<T>& p, const Plane<T>& lr, const T& straight) {
  return left_turn(p.u0, straight * lr + Plane<T>{-2.0 * lr.y, 2.0 * lr.x});
}
/// The last turn, to the right: the first turn minus the difference of the headings.
template <typename T>
[[gnu::always_inline]] inline T lsr_last(const Pair<T>& p, const T& turn) {
  const T last = turn - p.left;
  return last < 0.0 ? last + two_pi : last;
}

/// The three parts of a word; not finite when it does not exist.
struct Parts {
  double first = std::numeric_limits<double>::infinity();
  double middle = 0.0;
  double last = 0.0;
  double length() const { return first + middle + last; }
};

/// The numbers of LRL: the vector between its outer centres, and how far it is from straight.
template <typename T>
struct ThreeCircles {
  Plane<T> ll;
  T length;
  T sine;  ///< of half the angle that the middle arc lacks: |ll| / 4
  T cosine;
};

/// Whether LRL must be computed with more digits.
[[gnu::always_inline]] inline bool is_nearly_straight(double ll_length) {
  return std::abs(ll_length - 4.0) < 1e-3;
}

/// `length` below 4.
template <typename T>
[[gnu::always_inline]] inline ThreeCircles<T> three_circles_of(const Plane<T>& ll,
                                                               const T& length) {
  const T sine = 0.25 * length;
  return {ll, length, sine, root((1.0 - sine) * (1.0 + sine))};
}

/// The middle circle touches both others, on the side that makes its arc the long way round: with e
/// from the first centre to the touch, e = ll / 4 + left(ll) / |ll| sqrt(1 - (|ll| / 4)^2).
template <typename T>
struct MiddleCircle {
  Plane<T> touch;  ///< heading where it is entered
  Plane<T> end;    ///< heading there if no last arc is needed
  T middle;        ///< its arc
  T both;          ///< the first and the last arc together, or a whole turn less
};
template <typename T>
[[gnu::always_inline]] inline MiddleCircle<T> middle_circle(const Pair<T>& p,
                                                            const ThreeCircles<T>& of) {
  const T across = of.cosine / of.length;
  const Plane<T> e{0.25 * of.ll.x - across * of.ll.y, 0.25 * of.ll.y + across * of.ll.x};
  const T middle = two_pi - 2.0 * left_turn_to(Plane<T>{of.cosine, of.sine});
  const T sum = p.left + middle;
  const T c = (of.cosine - of.sine) * (of.cosine + of.sine);
  const T s = -2.0 * of.sine * of.cosine;
  return {left_of(e), c * p.u1 + s * left_of(p.u1), middle, sum >= two_pi ? sum - two_pi : sum};
}
/// Whether first and last arc add up to `both`. No allowance: see property 3.
template <typename T>
[[gnu::always_inline]] inline auto is_both(const Pair<T>& p, const MiddleCircle<T>& m) {
  return is_passed(p.u0, m.end, m.both, m.touch, m.both - m.both);
}
template <typename T>
[[gnu::always_inline]] inline T lrl_length(const Pair<T>& p, const ThreeCircles<T>& of) {
  const MiddleCircle<T> m = middle_circle(p, of);
  return m.middle + (is_both(p, m) ? m.both : m.both + two_pi);
}

/// A lower bound of LRL's length: its middle arc is 2 pi - 2 asin(|ll| / 4).
[[gnu::always_inline]] inline double lrl_bound(double ll_length) {
  return ll_length <= 4.001 ? two_pi - pi / 4 * ll_length : std::numeric_limits<double>::infinity();
}

/// LRL from the poses themselves, with more digits where they are needed.
double lrl_length(const Poses& poses, const Pair<double>& p);
Parts lrl_parts(const Poses& poses, const Pair<double>& p);
Parts lsl_parts(const Pair<double>& p);
Parts lsr_parts(const Pair<double>& p);

}  // namespace fairway::dubins
