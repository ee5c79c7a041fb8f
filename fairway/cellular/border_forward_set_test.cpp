#include "fairway/cellular/border_forward_set.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

#include "fairway/base/random.hpp"
#include "fairway/cellular/border_frame.hpp"
#include "fairway/cellular/testing/nearest_end.hpp"

namespace fairway {
namespace {

constexpr std::array<Side, 4> sides{Side::right, Side::top, Side::left, Side::bottom};

Direction direction(double rad) { return Direction::of(Heading::from_rad(rad)); }

double along(Side side, Vec2 p) { return side == Side::right || side == Side::left ? p.y : p.x; }

CellShape drawn_shape(Random& random) {
  const double d = random.uniform(0.5, 8.0);
  const double over = random.below(3) == 0 ? random.uniform(1e-6, 1e-3) : random.uniform(0.0, 4.0);
  return {d, d * (1.0 + over)};
}

double drawn_command(Random& random) {
  const double axis = (static_cast<double>(random.below(8)) - 3.0) * pi / 4;
  return random.below(4) == 0 ? axis : random.uniform(-pi, pi);
}

TEST(ForwardHeadings, HoldEveryExitOfExactMotion) {
  Random random(71);
  std::array<std::array<int, 4>, 4> met{};
  for (int draw = 0; draw < 600'000; ++draw) {
    const CellShape shape = drawn_shape(random);
    const Side entry = sides[random.below(4)];
    const Vec2 p = point_on(entry, shape.cell_m * random.unit(), shape.cell_m);
    const double inwards = static_cast<int>(entry) * (pi / 2) + pi;
    const bool shallow = random.below(4) == 0;
    const double off = shallow
                           ? (random.below(2) == 0 ? 1 : -1) * (pi / 2 - random.uniform(1e-3, 0.5))
                           : random.uniform(-pi / 2, pi / 2);
    const Direction heading = direction(inwards + off);
    const Direction command =
        random.below(20) == 0 ? Direction::none() : direction(drawn_command(random));
    const CellExit exit = cross_cell({p, heading}, command, shape);
    if (exit.on_corner(shape.cell_m)) continue;
    const HeadingSet set =
        forward_headings(entry, exit.side, along(exit.side, exit.state.position_m), command, shape);
    ASSERT_TRUE(set.holds(exit.state.heading.rad, 1e-7))
        << "entry " << static_cast<int>(entry) << " at " << p.x << ", " << p.y << " heading "
        << heading.rad << " command " << command.rad << " d " << shape.cell_m << " r "
        << shape.turn_radius_m << " exit " << static_cast<int>(exit.side) << " at "
        << exit.state.position_m.x << ", " << exit.state.position_m.y << " heading "
        << exit.state.heading.rad << " from end " << from_nearest_end(set, exit.state.heading.rad);
    ++met[static_cast<std::size_t>(entry)][static_cast<std::size_t>(exit.side)];
  }
  for (const auto& row : met) {
    for (const int count : row) EXPECT_GT(count, 1000);
  }
}

/// Whether exact motion leaves at `q` by `exit` with `heading_rad` from a start near `start`.
bool is_flown(const CellState& start, const Direction& command, const CellShape& shape, Side exit,
              Vec2 q, double heading_rad) {
  const CellExit flown = cross_cell(start, command, shape);
  return flown.side == exit && norm(flown.state.position_m - q) < 1e-5 * shape.cell_m &&
         std::abs(std::remainder(flown.state.heading.rad - heading_rad, two_pi)) < 1e-5;
}

/// A start on `entry` from which q is left by `exit` with `heading_rad`: the motion flown
/// backwards. Backwards, a left arc is a right arc from the reversed heading; before it, for the
/// command's own heading, any part of a straight line.
std::optional<CellState> start_before(Side entry, Side exit, Vec2 q, double heading_rad,
                                      const Direction& command, const CellShape& shape) {
  const double d = shape.cell_m;
  const Direction back = direction(heading_rad + pi);
  const auto try_arcs_from = [&](Vec2 from) -> std::optional<CellState> {
    for (const double turn : {1.0, -1.0}) {
      // Turning towards a heading a half turn away never ends within the cell.
      const CellExit start = cross_cell({from, back}, direction(back.rad + turn * 3.1), shape);
      if (start.side != entry || start.on_corner(d)) continue;
      const CellState state{start.state.position_m, direction(start.state.heading.rad + pi)};
      if (is_flown(state, command, shape, exit, q, heading_rad)) return state;
    }
    return std::nullopt;
  };
  const bool aligned = std::abs(std::remainder(heading_rad - command.rad, two_pi)) < 1e-9;
  if (!aligned) return try_arcs_from(q);
  const CellExit line = cross_cell({q, back}, Direction::none(), shape);
  const CellState straight{line.state.position_m, command};
  if (line.side == entry && is_flown(straight, command, shape, exit, q, heading_rad))
    return straight;
  for (int step = 0; step <= 400; ++step) {
    if (const auto start = try_arcs_from(q + line.straight_m * step / 400.0 * back.unit))
      return start;
  }
  return std::nullopt;
}

TEST(ForwardHeadings, AreAllFlown) {
  Random random(73);
  int inside = 0;
  int commands = 0;
  for (int draw = 0; draw < 30'000; ++draw) {
    const CellShape shape = drawn_shape(random);
    const Side entry = sides[random.below(4)];
    const Side exit = sides[random.below(4)];
    const double at = shape.cell_m * random.uniform(0.02, 0.98);
    const Vec2 q = point_on(exit, at, shape.cell_m);
    const Direction command = direction(drawn_command(random));
    const HeadingSet set = forward_headings(entry, exit, at, command, shape);
    const auto show = [&](double heading) {
      return ::testing::Message() << "entry " << static_cast<int>(entry) << " exit "
                                  << static_cast<int>(exit) << " at " << at << " heading "
                                  << heading << " command " << command.rad << " d " << shape.cell_m
                                  << " r " << shape.turn_radius_m;
    };
    for (const HeadingRange& range : set) {
      if (range.width_rad == 0.0) {
        // Barely possible alignments are not searched finely enough.
        if (set.count == 1 || !std::any_of(set.begin(), set.end(), [&](const HeadingRange& other) {
              return other.width_rad > 0.0 && other.holds(range.from_rad, 1e-9);
            })) {
          // The aligned interval's ends are those of arcs: away from them.
          HeadingSet nearby =
              forward_headings(entry, exit, at, direction(command.rad + 2e-3), shape);
          HeadingSet other =
              forward_headings(entry, exit, at, direction(command.rad - 2e-3), shape);
          if (!nearby.holds(command.rad + 2e-3, 1e-9) || !other.holds(command.rad - 2e-3, 1e-9))
            continue;
          ASSERT_TRUE(start_before(entry, exit, q, command.rad, command, shape))
              << show(command.rad);
          ++commands;
        }
        continue;
      }
      for (int k = 0; k < 5; ++k) {
        const double heading = range.from_rad + range.width_rad * random.uniform(0.001, 0.999);
        if (range.width_rad < 1e-3) continue;
        ASSERT_TRUE(start_before(entry, exit, q, heading, command, shape)) << show(heading);
        ++inside;
      }
    }
  }
  EXPECT_GT(inside, 20'000);
  EXPECT_GT(commands, 200);
}

TEST(ForwardHeadings, AtTheTopUnderAForwardCommandAreThoseOfFigure10) {
  const CellShape shape{1.0, 2.5};
  const double at = 0.5;
  const auto arc = [&](double corner_x, double turn) {  // exit heading of the arc from a corner
    const Vec2 chord{at - corner_x, 1.0};
    return std::atan2(chord.y, chord.x) + turn * std::asin(norm(chord) / 5.0);
  };
  const double right_l = arc(0.0, -1.0);
  const double right_r = arc(1.0, -1.0);
  const double left_l = arc(0.0, 1.0);
  const double left_r = arc(1.0, 1.0);
  ASSERT_LT(right_l, left_l);
  ASSERT_GT(right_r, left_l);  // Fig. 10b
  const auto hull = [&](double command) {
    const HeadingSet set = forward_headings(Side::bottom, Side::top, at, direction(command), shape);
    double low = 10.0;
    double high = -10.0;
    for (const HeadingRange& range : set) {
      low = std::min(low, range.from_rad);
      high = std::max(high, range.to_rad());
    }
    return std::array<double, 2>{low, high};
  };
  const auto expect = [&](double command, double low, double high) {
    EXPECT_NEAR(hull(command)[0], low, 1e-12) << command;
    EXPECT_NEAR(hull(command)[1], high, 1e-12) << command;
  };
  expect(0.5 * right_l, right_l, right_r);            // c1
  expect(right_l + 0.01, right_l + 0.01, right_r);    // c2
  expect(0.5 * (left_l + right_r), left_l, right_r);  // c3
  expect(left_r - 0.01, left_l, left_r - 0.01);       // c4
  expect(0.5 * (left_r + pi), left_l, left_r);        // c5
}

TEST(ForwardHeadings, AreASingleHeadingWhereOnlyAlignedPathsArrive) {
  // Fig. 10c: with a tight turn, right arcs end below the command and left ones above it.
  const CellShape shape{1.0, 1.1};
  const HeadingSet set = forward_headings(Side::bottom, Side::top, 0.5, direction(1.56), shape);
  ASSERT_EQ(set.count, 1U);
  EXPECT_EQ(set.ranges[0].width_rad, 0.0);
  EXPECT_NEAR(set.ranges[0].from_rad, 1.56, 1e-12);
}

TEST(ForwardHeadings, SplitInTwoForBackwardCommands) {
  const CellShape shape{1.0, 2.5};
  const HeadingSet set = forward_headings(Side::bottom, Side::top, 0.5, direction(-pi / 2), shape);
  ASSERT_EQ(set.count, 2U);                           // Fig. 12c
  const double limit = std::acos(-1.0 / 2.5);         // Eq. 12, the opposite heading being pi / 2
  EXPECT_NEAR(set.ranges[0].from_rad, limit, 1e-12);  // left turns
  EXPECT_NEAR(set.ranges[1].to_rad(), pi - limit, 1e-12);  // right turns, Eq. 13
  EXPECT_FALSE(set.holds(pi / 2));
}

TEST(ForwardHeadings, CanBeEmptyForBackwardCommands) {
  // The third region of Fig. 11: no left arc begins as far left as the opposite heading, no right
  // arc as far right.
  const auto from_below = [](double r) {
    return forward_headings(Side::bottom, Side::top, 0.5, direction(-pi / 2), {1.0, r});
  };
  EXPECT_TRUE(from_below(1.01).empty());
  EXPECT_FALSE(from_below(2.5).empty());
  int empty = 0;
  Random random(79);
  for (int draw = 0; draw < 5000; ++draw) {
    const double command = random.uniform(-pi, pi);
    const HeadingSet set = forward_headings(Side::bottom, Side::top, random.uniform(0.01, 0.99),
                                            direction(command), {1.0, random.uniform(1.01, 3.0)});
    if (set.empty()) {
      ++empty;
      EXPECT_LT(command, 0.0);
    }
  }
  EXPECT_GT(empty, 10);
}

TEST(ForwardHeadings, OfRightTurnsOnTheRightBorderEndAtEquation16) {
  // Fig. 20: the lower set exists up to y_max = r (1 + sin(theta_cp - pi / 2)).
  const double r = 2.0;
  const double opposite = 0.4;
  const CellShape shape{1.0, r};
  const double y_max = r * (1.0 + std::sin(opposite - pi / 2));
  ASSERT_LT(y_max, 1.0);
  const auto ranges_at = [&](double y) {
    return forward_headings(Side::bottom, Side::right, y, direction(opposite - pi), shape).count;
  };
  EXPECT_EQ(ranges_at(y_max - 1e-6), ranges_at(y_max + 1e-6) + 1);
}

TEST(ForwardHeadings, TurnWithTheCell) {
  Random random(83);
  for (int draw = 0; draw < 3000; ++draw) {
    const CellShape shape = drawn_shape(random);
    const Side entry = sides[random.below(4)];
    const Side exit = sides[random.below(4)];
    const double at = shape.cell_m * random.uniform(0.02, 0.98);
    const double command = random.uniform(-pi, pi);
    const HeadingSet set = forward_headings(entry, exit, at, direction(command), shape);
    const Vec2 q = turned_in_cell(point_on(exit, at, shape.cell_m), 1, shape.cell_m);
    const Side after_exit = turned(exit, 1);
    const HeadingSet after = forward_headings(turned(entry, 1), after_exit, along(after_exit, q),
                                              direction(command + pi / 2), shape);
    for (int k = 0; k < 64; ++k) {
      const double h = (k + 0.4) * two_pi / 64;
      if (from_nearest_end(set, h) < 1e-6) continue;
      ASSERT_EQ(set.holds(h), after.holds(h + pi / 2));
    }
  }
}

TEST(ForwardHeadings, RefusePointsBeyondTheBorder) {
  EXPECT_THROW(
      static_cast<void>(forward_headings(Side::bottom, Side::top, 1.01, direction(0), {1.0, 2.0})),
      PreconditionViolation);
}

}  // namespace
}  // namespace fairway
