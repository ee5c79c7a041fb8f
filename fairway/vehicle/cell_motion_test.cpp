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

/// The bang-bang motion in long double from angles alone: nothing of the kernel's geometry.
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
  /// Lengths at which the arc heads along an axis: where x or y is extreme.
  std::vector<Wide> extremes(Wide until) const {
    std::vector<Wide> lengths;
    for (int k = -8; turn != 0 && k <= 8; ++k) {
      const Wide a = turn * (k * wide_pi / 2 - h);
      if (a > 0 && a < angle && a * r < until) lengths.push_back(a * r);
    }
    return lengths;
  }
};

/// What makes an exit right: it lies on the border, on the motion, the motion was inside before,
/// and heads outwards (or touches) there.
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

/// A number in [0, d] with ends, middles and near misses on purpose.
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

TEST(CellMotion, exits_where_the_exact_motion_does) {
  Random random(11);
  for (int i = 0; i < 100000; ++i) {
    expect_exit(draw_any(random));
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace fairway
