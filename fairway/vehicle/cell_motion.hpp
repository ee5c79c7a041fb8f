// The exact motion of the vehicle through one cell under the bang-bang law (docs/model.md; paper 2,
// section "motion inside a cell"): at most one arc, then a straight line.
//
// Coordinates are the cell's own, (0, 0) at its lower left corner, so that numbers, and rounding
// errors, stay as small as the cell. A heading is kept as an angle and as a unit vector: geometry
// uses the vector and square roots, only lengths use angles (chord_angle.hpp, at most once a
// crossing).
//
// Properties that always hold, for a state in the closed cell and cell_m < turn_radius_m:
//   1. The exit lies on the closed border: the coordinate across its side is exactly 0 or cell_m,
//      the other one in [0, cell_m].
//   2. In one cell the vehicle turns by less than 90 degrees: the cell is convex, so the chord of
//      an arc inside is at most sqrt(2) cell_m < sqrt(2) r, and a chord is 2 r sin(angle / 2).
//   3. After aligning, the heading is the command, bit for bit.
//   4. A heading along a border keeps its zero component exactly; 0 stays 0.
//   5. A touch (the arc's extreme point on the border) is an exit whose heading runs along it.
//   6. Mirroring or rotating the cell by 90 degrees changes the result only by rounding.
// Error (observed over random draws against long double, see the test): the exit point lies within
// 2e-14 turn radii of where the exact motion is after length_m(). Where an exit grazes its side,
// the length itself is only accurate to the square root of the rounding error.
// `&` and `|` join conditions that are cheap and unpredictable for the branch predictor: one jump,
// where `&&` and `||` would have several.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fairway/base/heading.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/vehicle/cell_shape.hpp"
#include "fairway/vehicle/chord_angle.hpp"
#include "fairway/vehicle/side.hpp"

namespace fairway {

/// A direction in two forms: unit vector and angle in (-pi, pi].
struct Direction {
  Vec2 unit{1.0, 0.0};
  double rad = 0.0;

  static constexpr Direction none() {
    return {{0.0, 0.0}, std::numeric_limits<double>::quiet_NaN()};
  }
  /// The doubles pi and +-pi/2 stand for the axes themselves: their unit vectors are exact.
  static Direction of(Heading heading) {
    const double h = heading.rad();
    if (h == pi) return {{-1.0, 0.0}, h};
    if (h == pi / 2) return {{0.0, 1.0}, h};
    if (h == -pi / 2) return {{0.0, -1.0}, h};
    return {heading.unit(), h};
  }
};

enum class CellPath : std::uint8_t { straight, arc, arc_then_straight };

struct CellState {
  Vec2 position_m;  ///< in [0, cell_m]^2
  Direction heading;
};

struct CellExit {
  CellState state;  ///< on the border crossed, in the coordinates of the cell that is left
  Vec2 arc_end_m;   ///< where the arc ends (the start when there is none)
  double arc_m = 0.0;
  double straight_m = 0.0;
  int turn = 0;  ///< +1 left, -1 right, 0 no arc
  Side side = Side::right;
  CellPath path = CellPath::straight;

  double length_m() const { return arc_m + straight_m; }
  bool on_corner(double cell_m) const {
    const Vec2 p = state.position_m;
    return ((p.x == 0.0) | (p.x == cell_m)) & ((p.y == 0.0) | (p.y == cell_m));
  }
  /// The heading runs along the side: a touch, not a crossing.
  bool is_touch() const {
    const bool vertical = side == Side::right || side == Side::left;
    return (vertical ? state.heading.unit.x : state.heading.unit.y) == 0.0;
  }
};

/// The side on which the command lies: +1 left, -1 right, 0 aligned or no command. Exactly opposite
/// (difference of the angles exactly pi in double) turns left.
inline int turn_towards(const Direction& heading, const Direction& command) {
  const double sine = cross(heading.unit, command.unit);
  const double cosine = dot(heading.unit, command.unit);
  if ((cosine < 0.0) & (std::abs(sine) < 1e-9)) [[unlikely]] {
    const double d = command.rad - heading.rad;  // |d| is within 1e-8 of pi
    return (d > 0.0) == (std::abs(d) <= pi) || std::abs(d) == pi ? 1 : -1;
  }
  return (sine > 0.0) - (sine < 0.0);
}

/// |b - a| on the circle, [0, pi].
inline double angle_between(double a_rad, double b_rad) {
  const double d = std::abs(b_rad - a_rad);
  return d > pi ? two_pi - d : d;
}

namespace cell_motion {

/// From the start to the end of an arc of radius r that turns from u to c: r tan(angle / 2) along
/// u + c. In the difference left(u) - left(c), rounding would swamp the part across a short arc.
inline Vec2 arc_move(Vec2 u, Vec2 c, double r) {
  return (r * std::abs(cross(u, c)) / (1.0 + dot(u, c))) * (u + c);
}

/// `p` with its coordinate across `side` set exactly to that side. Rounding may have carried the
/// other one past a corner by an ulp of cell_m: then the exit is that corner.
inline Vec2 on_side(Vec2 p, Side side, double cell_m) {
  const bool vertical = side == Side::right || side == Side::left;
  const double at = side == Side::right || side == Side::top ? cell_m : 0.0;
  const Vec2 inside{std::clamp(p.x, 0.0, cell_m), std::clamp(p.y, 0.0, cell_m)};
  return {vertical ? at : inside.x, vertical ? inside.y : at};
}

/// Straight from p along u to the first border. Compares gap_x / |u_x| with gap_y / |u_y| by
/// cross-multiplying: no division by zero, and only one division.
inline void exit_straight(Vec2 p, Vec2 u, double cell_m, CellExit& exit) {
  const double gap_x = u.x > 0.0 ? cell_m - p.x : p.x;
  const double gap_y = u.y > 0.0 ? cell_m - p.y : p.y;
  const double ax = std::abs(u.x);
  const double ay = std::abs(u.y);
  const double to_vertical = gap_x * ay;
  const double to_horizontal = gap_y * ax;
  const bool vertical = to_vertical < to_horizontal || (to_vertical == to_horizontal && ax >= ay);
  exit.straight_m = (vertical ? gap_x : gap_y) / (vertical ? ax : ay);
  const Side side_x = u.x > 0.0 ? Side::right : Side::left;
  const Side side_y = u.y > 0.0 ? Side::top : Side::bottom;
  exit.side = vertical ? side_x : side_y;
  exit.state.position_m = on_side(p + exit.straight_m * u, exit.side, cell_m);
}

/// The symmetry of the square that maps every turn to a left turn from a heading in [0, 90)
/// degrees: axes `ahead` and `above` with u between them, where the heading turns towards `above`.
struct Canonical {
  int ahead_side;
  int turn;
  Vec2 ahead;
  Vec2 above;

  Canonical(Vec2 u, int turn_) : turn(turn_) {
    // The signs of u.x and u.y select the axis that u lies on or has just passed.
    static constexpr std::array<std::array<std::int8_t, 9>, 2> sides{{
        // y:  -      0       +      (x -, 0, + in each)
        {2, 3, 3, 2, 0, 0, 1, 1, 0},  // turning left
        {3, 3, 0, 2, 0, 0, 2, 1, 1},  // turning right
    }};
    const int column = (u.x > 0.0) - (u.x < 0.0) + 1;
    const int row = (u.y > 0.0) - (u.y < 0.0) + 1;
    ahead_side = sides[turn > 0 ? 0 : 1][static_cast<std::size_t>(3 * row + column)];
    // Exact, for whole quarter turns; a sine is minus the cosine one quarter turn on.
    static constexpr std::array<double, 5> cosines{1.0, 0.0, -1.0, 0.0, 1.0};
    const auto k = static_cast<std::size_t>(ahead_side);
    ahead = {cosines[k], -cosines[k + 1]};
    above = static_cast<double>(turn) * left_of(ahead);
  }
  Vec2 into(Vec2 v) const { return {dot(v, ahead), dot(v, above)}; }
  Vec2 out_of(Vec2 v) const { return v.x * ahead + v.y * above; }
  /// The side in the world that is side `s` (0 ahead, 1 above, 2 behind) here.
  Side side(int s) const { return static_cast<Side>((ahead_side + s * turn) & 3); }
};

struct ArcExit {
  int side;   // canonical
  Vec2 move;  // from the start
  Vec2 heading;
};

/// Whether a left arc reaches the right side, `ahead` away: its heading there, squared x component.
inline double square_at_right(Vec2 u, double k) { return u.x * u.x - k * (2.0 * u.y + k); }

/// The first exit of a left arc of radius r with unit heading u, u.x > 0, u.y >= 0, from a point
/// with gaps `ahead` (right side), `above` (top) and `behind` (left side).
///
/// On the arc the heading w and the displacement m satisfy w - u = left(m) / r:
///   w.x = u.x - m.y / r,   w.y = u.y + m.x / r,
/// and m is along u + w (the chord halves the angle). So a side fixes one component of m, hence one
/// of w; the other is a square root, written without 1 - w^2, which is inaccurate when small:
///   w.y^2 = u.y^2 + g (2 u.x - g)  with g = m.y / r;   w.x^2 = u.x^2 - g (2 u.y + g), g = m.x / r.
/// Turning less than 90 degrees (property 2), the heading stays in [0, 180): y always grows (so
/// the exit is never the bottom), x grows up to heading 90 degrees and falls after it. Hence the
/// order of the tests: top before 90 degrees, right, top after it, left.
inline ArcExit first_arc_exit(Vec2 u, const CellShape& shape, double ahead, double above,
                              double behind) {
  const double g = above * shape.per_radius;
  const Vec2 w{u.x - g, std::sqrt(std::max(0.0, u.y * u.y + g * (2.0 * u.x - g)))};
  const double to_top_x = above > 0.0 ? above * (u.x + w.x) / (u.y + w.y) : 0.0;
  const double k_right = ahead * shape.per_radius;
  const double square = square_at_right(u, k_right);
  const bool top_first = w.x >= 0.0 ? to_top_x <= ahead : square < 0.0 && to_top_x >= -behind;
  if (top_first) return {1, {to_top_x, above}, w};
  if (w.x >= 0.0 || square >= 0.0) {
    const Vec2 v{std::sqrt(std::max(0.0, square)), u.y + k_right};
    return {0, {ahead, std::min(above, ahead * (u.y + v.y) / (u.x + v.x))}, v};
  }
  const double k = behind * shape.per_radius;
  const Vec2 v{-std::sqrt(std::max(0.0, u.x * u.x + k * (2.0 * u.y - k))), u.y - k};
  return {2, {-behind, std::min(above, shape.turn_radius_m * (u.x - v.x))}, v};
}

/// A turn that leaves the heading's quadrant, or leaves the cell before it ends.
inline void exit_turning(const CellState& s, const Direction& command, const CellShape& shape,
                         CellExit& exit) {
  const double d = shape.cell_m;
  const double r = shape.turn_radius_m;
  const Vec2 p = s.position_m;
  const Canonical canonical(s.heading.unit, exit.turn);
  const Vec2 u = canonical.into(s.heading.unit);
  const std::array<double, 4> gap{d - p.x, d - p.y, p.x, p.y};
  const auto gap_at = [&](int side) { return gap[static_cast<std::size_t>(canonical.side(side))]; };
  const double ahead = gap_at(0);
  const double above = gap_at(1);
  const double behind = gap_at(2);

  // Aligned inside past heading 90 degrees: the arc is monotone before and after its extreme point.
  const Vec2 c = canonical.into(command.unit);
  if ((c.x <= 0.0) & (c.y > 0.0) & (dot(u, c) >= 0.0) &
      (square_at_right(u, ahead * shape.per_radius) < 0.0)) {
    const Vec2 move = arc_move(u, c, r);
    if (move.x >= -behind && move.y <= above) {
      const Vec2 q = p + canonical.out_of(move);
      exit.arc_end_m = {std::clamp(q.x, 0.0, d), std::clamp(q.y, 0.0, d)};
      exit.arc_m = r * angle_between(s.heading.rad, command.rad);
      exit.path = CellPath::arc_then_straight;
      exit.state.heading = command;
      exit_straight(exit.arc_end_m, command.unit, d, exit);
      return;
    }
  }

  const ArcExit arc = first_arc_exit(u, shape, ahead, above, behind);
  const double angle = chord_angle(arc.move, 0.5 * shape.per_radius);
  // One Newton step towards length 1 keeps long turns from drifting.
  const double scale = 1.5 - 0.5 * norm2(arc.heading);
  exit.side = canonical.side(arc.side);
  const Vec2 q = on_side(p + canonical.out_of(arc.move), exit.side, d);
  exit.arc_m = r * angle;
  exit.path = CellPath::arc;
  exit.arc_end_m = q;
  double rad = s.heading.rad + exit.turn * angle;
  if (rad > pi) rad -= two_pi;
  if (rad <= -pi) rad += two_pi;
  exit.state = {q, {scale * canonical.out_of(arc.heading), rad}};
}

}  // namespace cell_motion

/// Flies from `s` to the first exit of the cell under `command` (Direction::none(): straight).
/// A state on the border must head inwards or along it; one that heads outwards leaves at once.
inline CellExit cross_cell(const CellState& s, const Direction& command, const CellShape& shape) {
  const double d = shape.cell_m;
  const double r = shape.turn_radius_m;
  const Vec2 u = s.heading.unit;
  const Vec2 c = command.unit;
  CellExit exit;
  exit.arc_end_m = s.position_m;
  exit.turn = turn_towards(s.heading, command);
  if (exit.turn == 0) {
    exit.state.heading = s.heading;
    cell_motion::exit_straight(s.position_m, u, d, exit);
    return exit;
  }
  // The common case, a turn within one closed quadrant of headings: x and y are monotone along the
  // arc, so it stays in the cell if its end does.
  if (u.x * c.x >= 0.0 && u.y * c.y >= 0.0) {
    const Vec2 q = s.position_m + cell_motion::arc_move(u, c, r);
    if (q.x >= 0.0 && q.x <= d && q.y >= 0.0 && q.y <= d) {
      exit.arc_end_m = q;
      exit.arc_m = r * angle_between(s.heading.rad, command.rad);
      exit.path = CellPath::arc_then_straight;
      exit.state.heading = command;
      cell_motion::exit_straight(q, c, d, exit);
      return exit;
    }
  }
  cell_motion::exit_turning(s, command, shape, exit);
  return exit;
}

}  // namespace fairway
