#include "fairway/vehicle/cell_motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ostream>
#include <vector>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

using Wide = long double;
constexpr Wide wide_pi = 3.14159265358979323846264338327950288L;

struct Draw {
  CellState state;
  Direction command;
  CellShape shape;
};

std::ostream& operator<<(std::ostream& out, const Draw& d) {
  out.precision(17);
  return out << "p=(" << d.state.position_m.x << ", " << d.state.position_m.y
             << ") h=" << d.state.heading.rad << " psi=" << d.command.rad << " d=" << d.shape.cell_m
             << " r=" << d.shape.turn_radius_m;
}

Direction direction(double rad) { return Direction::of(Heading::from_rad(rad)); }

/// The bang-bang motion in long double from angles alone, without the kernel's geometry.
struct Truth {
  Wide x0, y0, h, r, turn, angle;

  explicit Truth(const Draw& d)
      : x0(d.state.position_m.x),
        y0(d.state.position_m.y),
        h(d.state.heading.rad),
        r(d.shape.turn_radius_m),
        turn(0),
        angle(0) {
    if (std::isnan(d.command.rad)) return;
    const double difference = d.command.rad - d.state.heading.rad;
    angle = std::remainder(static_cast<Wide>(d.command.rad) - h, 2 * wide_pi);
    turn = angle > 0 ? 1 : angle < 0 ? -1 : 0;
    if (std::abs(difference) == pi) turn = 1;  // exactly opposite: left
    angle = std::abs(angle);
  }
  Wide heading(Wide length) const { return h + turn * std::min(length / r, angle); }
  std::array<Wide, 2> position(Wide length) const {
    const Wide a = std::min(length / r, angle);
    const Wide w = heading(length);
    Wide x = x0;
    Wide y = y0;
    if (turn != 0) {
      x += turn * r * (std::sin(w) - std::sin(h));
      y -= turn * r * (std::cos(w) - std::cos(h));
    }
    const Wide rest = turn == 0 ? length : length - r * a;
    return {x + rest * std::cos(w), y + rest * std::sin(w)};
  }
  /// Lengths at which the arc heads along an axis, where x or y is extreme.
  std::vector<Wide> extremes(Wide until) const {
    std::vector<Wide> lengths;
    for (int k = -8; turn != 0 && k <= 8; ++k) {
      const Wide a = turn * (k * wide_pi / 2 - h);
      if (a > 0 && a < angle && a * r < until) lengths.push_back(a * r);
    }
    return lengths;
  }
};

/// What makes an exit correct: it lies on the border and on the motion, which was inside before and
/// heads outwards (or touches) there.
void expect_exit(const Draw& draw) {
  SCOPED_TRACE(::testing::PrintToString(draw));
  const double d = draw.shape.cell_m;
  const double r = draw.shape.turn_radius_m;
  const CellExit exit = cross_cell(draw.state, draw.command, draw.shape);
  const Vec2 p = exit.state.position_m;
  const Vec2 u = exit.state.heading.unit;
  const Truth truth(draw);
  const Wide length = exit.length_m();

  ASSERT_GE(length, 0.0L);
  ASSERT_GE(exit.straight_m, 0.0);
  const bool vertical = exit.side == Side::right || exit.side == Side::left;
  const bool upper = exit.side == Side::right || exit.side == Side::top;
  ASSERT_EQ(vertical ? p.x : p.y, upper ? d : 0.0);
  ASSERT_GE(std::min(p.x, p.y), 0.0);
  ASSERT_LE(std::max(p.x, p.y), d);

  const auto end = truth.position(length);
  const double tolerance = 2e-14 * r;
  ASSERT_NEAR(static_cast<double>(end[0] - p.x), 0.0, tolerance);
  ASSERT_NEAR(static_cast<double>(end[1] - p.y), 0.0, tolerance);
  const Wide off = std::remainder(truth.heading(length) - exit.state.heading.rad, 2 * wide_pi);
  ASSERT_NEAR(static_cast<double>(off), 0.0, 1e-14);
  ASSERT_NEAR(std::cos(exit.state.heading.rad), u.x, 1e-14);
  ASSERT_NEAR(std::sin(exit.state.heading.rad), u.y, 1e-14);
  ASSERT_LE(exit.arc_m, r * pi / 2 * (1 + 1e-12));

  std::vector<Wide> before = truth.extremes(length);
  for (int i = 0; i <= 32; ++i) before.push_back(length * i / 32);
  for (const Wide at : before) {
    const auto q = truth.position(at);
    ASSERT_GE(std::min(q[0], q[1]), -tolerance);
    ASSERT_LE(std::max(q[0], q[1]), d + tolerance);
  }
  const double outwards = (upper ? 1.0 : -1.0) * (vertical ? u.x : u.y);
  ASSERT_GE(outwards, 0.0);
}

/// A number in [0, d], with ends, midpoints and near misses on purpose.
double coordinate(Random& random, double d) {
  switch (random.below(12)) {
    case 0:
      return 0.0;
    case 1:
      return d;
    case 2:
      return d / 2;
    case 3:
      return 1e-9 * d;
    case 4:
      return d - 1e-9 * d;
    case 5:
      return 1e-16 * d;
    default:
      return random.uniform(0.0, d);
  }
}

double angle(Random& random) {
  const double axis = (static_cast<double>(random.below(9)) - 4.0) * pi / 4;
  switch (random.below(10)) {
    case 0:
      return axis;
    case 1:
      return axis + random.uniform(-1e-8, 1e-8);
    case 2:
      return axis + random.uniform(-1e-3, 1e-3);
    case 3:
      return static_cast<double>(Heading::stored(axis));
    default:
      return random.uniform(-pi, pi);
  }
}

/// Headings of states on a border point into the cell or along it.
void head_inwards(CellState& s, double d) {
  Vec2& u = s.heading.unit;
  if ((s.position_m.x == 0.0 && u.x < 0.0) || (s.position_m.x == d && u.x > 0.0)) {
    s.heading = direction(pi - s.heading.rad);
  }
  if ((s.position_m.y == 0.0 && u.y < 0.0) || (s.position_m.y == d && u.y > 0.0)) {
    s.heading = direction(-s.heading.rad);
  }
}

Draw draw_any(Random& random) {
  Draw draw;
  const double d = random.below(2) == 0 ? 8.0 : random.uniform(0.1, 10.0);
  const double ratios[] = {1.0 + 1e-9, 1.25, 2.5, 20.0, random.uniform(1.001, 4.0)};
  draw.shape = {d, d * ratios[random.below(5)]};
  draw.state = {{coordinate(random, d), coordinate(random, d)}, direction(angle(random))};
  head_inwards(draw.state, d);
  const double h = draw.state.heading.rad;
  switch (random.below(8)) {
    case 0:
      draw.command = Direction::none();
      break;
    case 1:
      draw.command = direction(h);
      break;
    case 2:
      draw.command = direction(h > 0.0 ? h - pi : h + pi);
      break;
    case 3:
      draw.command = direction(h + random.uniform(-1e-8, 1e-8));
      break;
    case 4:
      draw.command = direction(h + random.uniform(-0.5, 0.5));
      break;
    default:
      draw.command = direction(angle(random));
      break;
  }
  return draw;
}

TEST(CellMotion, ExitsWhereTheExactMotionDoes) {
  Random random(11);
  for (int i = 0; i < 100000; ++i) {
    expect_exit(draw_any(random));
    if (HasFatalFailure()) return;
  }
}

/// Under every symmetry of the square: `map` must be exact in floating point on vectors.
struct Symmetry {
  double angle;  // added
  bool mirror;   // y to -y, first

  Vec2 vector(Vec2 v) const {
    if (mirror) v.y = -v.y;
    for (double a = 0.0; a < angle; a += pi / 2) v = left_of(v);
    return v;
  }
  Vec2 point(Vec2 p, double d) const {
    if (mirror) p.y = d - p.y;
    for (double a = 0.0; a < angle; a += pi / 2) p = {d - p.y, p.x};
    return p;
  }
  Direction direction(const Direction& h) const {
    return {vector(h.unit), Heading::from_rad((mirror ? -h.rad : h.rad) + angle).rad()};
  }
};

TEST(CellMotion, TurnsAndMirrorsWithItsCell) {
  Random random(12);
  for (int i = 0; i < 50000; ++i) {
    Draw draw = draw_any(random);
    // Positions for which cell_m - p is exact, so that the symmetric cases are the same case.
    draw.shape = {8.0, 8.0 * random.uniform(1.01, 4.0)};
    draw.state.position_m = {0x1p-30 * static_cast<double>(random.below((8ULL << 30) + 1)),
                             0x1p-30 * static_cast<double>(random.below((8ULL << 30) + 1))};
    if (random.below(4) == 0) draw.state.position_m.x = random.below(2) == 0 ? 0.0 : 8.0;
    if (random.below(4) == 0) draw.state.position_m.y = random.below(2) == 0 ? 0.0 : 8.0;
    head_inwards(draw.state, 8.0);
    // Ties are broken to the left, and a grazing exit may fall to either side of a corner.
    if (turn_towards(draw.state.heading, draw.command) == 0 ||
        std::abs(std::abs(draw.command.rad - draw.state.heading.rad) - pi) < 1e-12) {
      continue;
    }
    const CellExit exit = cross_cell(draw.state, draw.command, draw.shape);
    for (const Symmetry symmetry : {Symmetry{pi / 2, false}, Symmetry{pi, false},
                                    Symmetry{3 * pi / 2, false}, Symmetry{0.0, true}}) {
      const double d = draw.shape.cell_m;
      const CellState turned{symmetry.point(draw.state.position_m, d),
                             symmetry.direction(draw.state.heading)};
      const CellExit other = cross_cell(turned, symmetry.direction(draw.command), draw.shape);
      const Vec2 off = other.state.position_m - symmetry.point(exit.state.position_m, d);
      // The square root of the rounding error where the exit grazes the border, else that error.
      const double grazing =
          std::min(std::abs(exit.state.heading.unit.x), std::abs(exit.state.heading.unit.y));
      const double tolerance = 1e-14 * draw.shape.turn_radius_m / std::max(grazing, 1e-7);
      ASSERT_LE(norm(off), tolerance) << ::testing::PrintToString(draw) << " turned by "
                                      << symmetry.angle << " mirrored " << symmetry.mirror;
      ASSERT_NEAR(other.length_m(), exit.length_m(), tolerance);
    }
  }
}

TEST(CellMotion, TurnsLeftWhenTheCommandIsExactlyOpposite) {
  const CellShape shape{8.0, 20.0};
  for (const double h : {0.0, pi, pi / 2, -pi / 2, 1.0, -2.5, 3.0}) {
    const CellState start{{4.0, 4.0}, direction(h)};
    const CellExit exit = cross_cell(start, direction(h > 0.0 ? h - pi : h + pi), shape);
    EXPECT_EQ(exit.turn, 1) << h;
    EXPECT_EQ(exit.path, CellPath::arc) << h;
  }
}

TEST(CellMotion, FliesStraightWithoutACommand) {
  const CellExit exit =
      cross_cell({{1.0, 2.0}, direction(pi / 2)}, Direction::none(), CellShape{8.0, 20.0});
  EXPECT_EQ(exit.path, CellPath::straight);
  EXPECT_EQ(exit.side, Side::top);
  EXPECT_EQ(exit.state.position_m, (Vec2{1.0, 8.0}));
  EXPECT_EQ(exit.length_m(), 6.0);
}

TEST(CellMotion, ReturnsThroughTheSideItCameInByWithTheMirroredHeading) {
  // The chord 2 r sin(0.1) = 0.998 stays within the side.
  const CellShape shape{8.0, 5.0 + 4.0};
  const CellExit exit = cross_cell({{2.0, 0.0}, direction(0.1)}, direction(-1.0), shape);
  EXPECT_EQ(exit.side, Side::bottom);
  EXPECT_EQ(exit.path, CellPath::arc);
  EXPECT_NEAR(exit.state.heading.rad, -0.1, 1e-15);
  EXPECT_NEAR(exit.state.position_m.x, 2.0 + 18.0 * std::sin(0.1), 1e-14);
  EXPECT_NEAR(exit.arc_m, 9.0 * 0.2, 1e-15);
}

TEST(CellMotion, ReportsATouchOfCircleAndSideOrPassesIt) {
  // Circles whose extreme point lies on the right side up to rounding: some touch exactly, some
  // cross, some miss. In each case, the point is the extreme one, or a later exit.
  Random random(13);
  int touches = 0;
  for (int i = 0; i < 20000; ++i) {
    const CellShape shape{4.0, 5.0};
    const double h = random.uniform(0.9, 1.5);
    const Vec2 u = direction(h).unit;
    const double x = 4.0 - 5.0 * (1.0 - u.y);
    const double y = random.uniform(0.0, 4.0 - 5.0 * u.x);
    if (x < 0.0 || y < 0.0) continue;
    const Draw draw{{{x, y}, direction(h)}, direction(h + 3.0), shape};
    expect_exit(draw);
    const CellExit exit = cross_cell(draw.state, draw.command, shape);
    if (exit.side == Side::right) {
      ASSERT_NEAR(exit.state.position_m.y, y + 5.0 * u.x, 1e-6);
    }
    if (exit.is_touch()) ++touches;
  }
  EXPECT_GT(touches, 0);
}

TEST(CellMotion, KnowsACorner) {
  const double d = 8.0;
  const Direction diagonal{{std::sqrt(0.5), std::sqrt(0.5)}, pi / 4};
  const CellExit exit = cross_cell({{2.0, 2.0}, diagonal}, diagonal, CellShape{d, 20.0});
  EXPECT_TRUE(exit.on_corner(d));
  EXPECT_EQ(exit.state.position_m, (Vec2{d, d}));
}

TEST(ChordAngle, IsTwiceTheArcSineOverTheWholeHalfTurn) {
  Random random(17);
  for (int i = 0; i < 200'000; ++i) {
    // Small and large, and around s = 1/2, where the polynomial ends.
    const double wanted = i % 3 == 0   ? std::pow(10.0, random.uniform(-12.0, 0.0))
                          : i % 3 == 1 ? random.uniform(0.0, 1.0)
                                       : 0.5 + random.uniform(-1e-12, 1e-12);
    const double diameter = random.uniform(0.1, 1000.0);
    const double direction_rad = random.uniform(-pi, pi);
    const Vec2 chord = wanted * diameter * Vec2{std::cos(direction_rad), std::sin(direction_rad)};
    const Wide s = std::hypot(static_cast<Wide>(chord.x), static_cast<Wide>(chord.y)) /
                   static_cast<Wide>(diameter);
    const Wide exact = 2 * std::asin(std::min<Wide>(1, s));
    // The effect of rounding s on the angle, and a little more.
    const Wide tolerance = 6e-16L * (s / std::sqrt(std::max<Wide>(1e-16L, 1 - s * s)) + exact);
    ASSERT_NEAR(chord_angle(chord, 1.0 / diameter), static_cast<double>(exact),
                static_cast<double>(tolerance))
        << "s = " << wanted << ", diameter " << diameter;
  }
  EXPECT_EQ(chord_angle({0.0, 0.0}, 0.1), 0.0);
  EXPECT_EQ(chord_angle({0.0, 10.000001}, 0.1), pi);
}

}  // namespace
}  // namespace fairway
