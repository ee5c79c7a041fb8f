// The six words one by one, in units of the turning radius. Private to the Dubins sources.
//
// Everything is in the frame of the world, moved to the start: no rotation is needed. The words
// that begin with a right turn are those that begin with a left one, seen in a mirror.
#pragma once

#include <cmath>
#include <limits>

#include "fairway/base/heading.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/steer/fast_angle.hpp"

namespace fairway::dubins {

/// Two poses as the words see them.
struct Pair {
  Vec2 u0;  ///< unit vectors of the headings
  Vec2 u1;
  Vec2 d;             ///< from start to goal
  double left = 0.0;  ///< the turn from heading to heading, to the left, [0, 2 pi]
  double right = 0.0;
  double near = 0.0;  ///< property 3
  Vec2 from_m;        ///< what all that came from, for the few that need more digits
  Vec2 to_m;
  double h0 = 0.0;
  double h1 = 0.0;
  double turn_radius_m = 1.0;

  // Between centres: left to left, right to right, left to right, right to left.
  [[gnu::always_inline]] Vec2 ll() const { return d + (left_of(u1) - left_of(u0)); }
  [[gnu::always_inline]] Vec2 rr() const { return d - (left_of(u1) - left_of(u0)); }
  [[gnu::always_inline]] Vec2 lr() const { return d - (left_of(u1) + left_of(u0)); }
  [[gnu::always_inline]] Vec2 rl() const { return d + (left_of(u1) + left_of(u0)); }
};

[[gnu::always_inline]] inline Vec2 mirrored(Vec2 v) { return {v.x, -v.y}; }

[[gnu::always_inline]] inline Pair mirrored(const Pair& p) {
  return {mirrored(p.u0),     mirrored(p.u1),   mirrored(p.d), p.right, p.left,         p.near,
          mirrored(p.from_m), mirrored(p.to_m), -p.h0,         -p.h1,   p.turn_radius_m};
}

/// Headings in (-pi, pi].
[[gnu::always_inline]] inline Pair pair_of(double x0, double y0, double h0, double x1, double y1,
                                           double h1, double turn_radius_m) {
  Pair p;
  const double per_radius = 1.0 / turn_radius_m;
  p.from_m = {x0, y0};
  p.to_m = {x1, y1};
  p.h0 = h0;
  p.h1 = h1;
  p.turn_radius_m = turn_radius_m;
  p.d = {(x1 - x0) * per_radius, (y1 - y0) * per_radius};
  p.u0 = fast_unit(h0);
  p.u1 = fast_unit(h1);
  const double turn = h1 - h0;
  p.left = turn < 0.0 ? turn + two_pi : turn;
  p.right = turn > 0.0 ? two_pi - turn : -turn;
  p.near = 1e-13 * (1.0 + (std::abs(p.d.x) + std::abs(p.d.y)));
  return p;
}

/// Whether `v` is |v| in a direction that a left turn from u0 to u1 passes, within `near`: in the
/// cone between them, which is convex up to half a turn and the complement of a convex one beyond.
[[gnu::always_inline]] inline bool is_passed(Vec2 u0, Vec2 u1, double left, Vec2 v, double near) {
  const bool after = cross(u0, v) >= -near;
  const bool before = cross(v, u1) >= -near;
  const bool ahead = dot(v, u0 + u1) >= -2.0 * near;
  return ((left > pi) & (after | before)) | (after & before & ahead);
}
[[gnu::always_inline]] inline bool is_passed(const Pair& p, Vec2 v) {
  return is_passed(p.u0, p.u1, p.left, v, p.near);
}

/// LSL: the turns add up to the turn between the headings, or to a whole turn more.
[[gnu::always_inline]] inline double lsl_length(const Pair& p) {
  const Vec2 ll = p.ll();
  const double straight = std::sqrt(norm2(ll));
  return (straight <= p.near ? 0.0 : straight) + (is_passed(p, ll) ? p.left : p.left + two_pi);
}

/// LSR exists when the circles are disjoint or touch. p^2 for a straight part p; below 0: none.
[[gnu::always_inline]] inline double crossing_square(const Pair& p, Vec2 between) {
  const double square = norm2(between) - 4.0;
  return (square < 0.0) & (square >= -4.0 * p.near) ? 0.0 : square;
}

/// The first turn of LSR: up to the direction of the straight part, which with (p, 2) as legs lies
/// to the left of `lr`.
[[gnu::always_inline]] inline double lsr_turn(const Pair& p, Vec2 lr, double straight) {
  return left_turn(p.u0, straight * lr + 2.0 * left_of(lr));
}
/// The last turn, to the right: what the first turned more than the headings differ.
[[gnu::always_inline]] inline double lsr_last(const Pair& p, double turn) {
  const double last = turn - p.left;
  return last < 0.0 ? last + two_pi : last;
}

/// The three parts of a word; not finite when it does not exist.
struct Parts {
  double first = std::numeric_limits<double>::infinity();
  double middle = 0.0;
  double last = 0.0;
  double length() const { return first + middle + last; }
};

Parts lsl_parts(const Pair& p);
Parts lsr_parts(const Pair& p);
Parts lrl_parts(const Pair& p);
double lrl_length(const Pair& p);

/// What LRL is made of: the vector between its outer centres, and how far it is from straight.
struct ThreeCircles {
  Vec2 ll;
  double length;
  double sine;  ///< of half the angle that the middle arc lacks: |ll| / 4
  double cosine;
};

/// Whether lrl_parts() must work with more digits.
[[gnu::always_inline]] inline bool is_nearly_straight(double ll_length) {
  return std::abs(ll_length - 4.0) < 1e-3;
}

[[gnu::always_inline]] inline ThreeCircles three_circles_of(Vec2 ll, double length) {
  const double sine = 0.25 * length;
  return {ll, length, sine, length < 4.0 ? std::sqrt((1.0 - sine) * (1.0 + sine)) : -1.0};
}

/// The middle circle touches both others, on the side that makes its arc the long way round: with e
/// from the first centre to the touch, e = ll / 4 + left(ll) / |ll| sqrt(1 - (|ll| / 4)^2).
struct MiddleCircle {
  Vec2 touch;     ///< heading where it is entered
  double middle;  ///< its arc
  double both;    ///< the first and the last arc together, or a whole turn less
  bool is_both;
};
[[gnu::always_inline]] inline MiddleCircle middle_circle(const Pair& p, const ThreeCircles& of) {
  const Vec2 e = 0.25 * of.ll + (of.cosine / of.length) * left_of(of.ll);
  MiddleCircle m;
  m.touch = left_of(e);
  m.middle = two_pi - 2.0 * left_turn_to({of.cosine, of.sine});
  const double sum = p.left + m.middle;
  m.both = sum >= two_pi ? sum - two_pi : sum;
  // Where the first arc would end that needs no last one.
  const double c = (of.cosine - of.sine) * (of.cosine + of.sine);
  const double s = -2.0 * of.sine * of.cosine;
  const Vec2 end = c * p.u1 + s * left_of(p.u1);
  m.is_both = is_passed(p.u0, end, m.both, m.touch, 0.0);
  return m;
}
[[gnu::always_inline]] inline double lrl_length(const Pair& p, const ThreeCircles& of) {
  const MiddleCircle m = middle_circle(p, of);
  return m.middle + (m.is_both ? m.both : m.both + two_pi);
}

/// A lower bound of LRL's length: its middle arc is 2 pi - 2 asin(|ll| / 4).
[[gnu::always_inline]] inline double lrl_bound(double ll_length) {
  return ll_length <= 4.001 ? two_pi - pi / 4 * ll_length : std::numeric_limits<double>::infinity();
}

}  // namespace fairway::dubins
