#include "fairway/cellular/border_backward_set.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fairway/base/random.hpp"
#include "fairway/cellular/border_frame.hpp"
#include "fairway/cellular/testing/nearest_end.hpp"

namespace fairway {
namespace {

constexpr std::array<Side, 4> sides{Side::right, Side::top, Side::left, Side::bottom};

Direction direction(double rad) { return Direction::of(Heading::from_rad(rad)); }

double drawn_command(Random& random) {
  const double axis = (static_cast<double>(random.below(8)) - 3.0) * pi / 4;
  const auto kind = random.below(4);
  return kind == 0   ? axis
         : kind == 1 ? axis + random.uniform(-1e-6, 1e-6)
                     : random.uniform(-pi, pi);
}

CellShape drawn_shape(Random& random) {
  const double d = random.uniform(0.5, 8.0);
  const double over = random.below(3) == 0 ? random.uniform(1e-9, 1e-3) : random.uniform(0.0, 4.0);
  return {d, d * (1.0 + over)};
}

/// Whether the exact motion agrees with the four sets about a heading. Near the ends of ranges
/// either answer is allowed.
struct Agreement {
  int agree = 0;
  int near_ends = 0;
};
void expect_agreement(Vec2 p, double heading_rad, const Direction& command, const CellShape& shape,
                      const std::array<HeadingSet, 4>& sets, Agreement& agreement) {
  const CellExit exit = cross_cell({p, direction(heading_rad)}, command, shape);
  for (const Side side : sides) {
    const HeadingSet& set = sets[static_cast<std::size_t>(side)];
    if (from_nearest_end(set, heading_rad) < 1e-7) {
      ++agreement.near_ends;
      continue;
    }
    ASSERT_EQ(set.holds(heading_rad), exit.side == side)
        << "p " << p.x << ", " << p.y << " heading " << heading_rad << " command " << command.rad
        << " d " << shape.cell_m << " r " << shape.turn_radius_m << " side "
        << static_cast<int>(side) << " exit " << static_cast<int>(exit.side);
    ++agreement.agree;
  }
}

std::array<HeadingSet, 4> sets_at(Vec2 p, const Direction& command, const CellShape& shape) {
  std::array<HeadingSet, 4> sets;
  for (const Side side : sides)
    sets[static_cast<std::size_t>(side)] = backward_headings(p, command, shape, side);
  return sets;
}

void compare(Vec2 p, const Direction& command, const CellShape& shape, int headings,
             Agreement& agreement) {
  const auto sets = sets_at(p, command, shape);
  for (int k = 0; k < headings; ++k) {
    expect_agreement(p, (k + 0.377) * two_pi / headings, command, shape, sets, agreement);
    if (::testing::Test::HasFatalFailure()) return;
  }
  // Close to every end, from both sides: the ends themselves are right.
  for (const HeadingSet& set : sets) {
    for (const HeadingRange& range : set) {
      for (const double end : {range.from_rad, range.to_rad()}) {
        for (const double off : {-2e-6, 2e-6})
          expect_agreement(p, end + off, command, shape, sets, agreement);
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

TEST(BackwardHeadings, OfPointsInsideAgreeWithExactMotionForAllBorders) {
  Random random(41);
  Agreement agreement;
  for (int draw = 0; draw < 4000; ++draw) {
    const CellShape shape = drawn_shape(random);
    const Vec2 p{random.uniform(0.0, shape.cell_m), random.uniform(0.0, shape.cell_m)};
    compare(p, direction(drawn_command(random)), shape, 90, agreement);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(agreement.agree, 1'000'000);
  EXPECT_LT(agreement.near_ends, agreement.agree / 1000);
}

TEST(BackwardHeadings, OfPointsOnBordersAgreeWithExactMotionForAllBorders) {
  Random random(43);
  Agreement agreement;
  for (int draw = 0; draw < 4000; ++draw) {
    const CellShape shape = drawn_shape(random);
    const Vec2 p =
        point_on(sides[random.below(4)], shape.cell_m * random.uniform(0.001, 0.999), shape.cell_m);
    compare(p, direction(drawn_command(random)), shape, 90, agreement);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(agreement.agree, 1'000'000);
}

TEST(BackwardHeadings, WithoutACommandAreTheDirectionsToTheBorder) {
  Random random(47);
  Agreement agreement;
  for (int draw = 0; draw < 500; ++draw) {
    const CellShape shape = drawn_shape(random);
    const Vec2 p{random.uniform(0.0, shape.cell_m), random.uniform(0.0, shape.cell_m)};
    compare(p, Direction::none(), shape, 60, agreement);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(agreement.agree, 50'000);
}

TEST(BackwardHeadings, OfTheFourBordersDivideTheCircle) {
  Random random(53);
  for (int draw = 0; draw < 5000; ++draw) {
    const CellShape shape = drawn_shape(random);
    const Vec2 p{random.uniform(0.0, shape.cell_m), random.uniform(0.0, shape.cell_m)};
    double width = 0.0;
    for (const HeadingSet& set : sets_at(p, direction(drawn_command(random)), shape)) {
      EXPECT_LE(set.count, 1U);
      for (const HeadingRange& range : set) width += range.width_rad;
    }
    ASSERT_NEAR(width, two_pi, 1e-9);
  }
}

TEST(BackwardHeadings, ForABackwardCommandCanBeEmpty) {
  // Eq. 11: r hardly larger than d, low in the cell, command down: the top is out of reach ...
  const CellShape tight{1.0, 1.05};
  EXPECT_TRUE(backward_headings({0.5, 0.1}, direction(-pi / 2), tight, Side::top).empty());
  // ... but not with a wide turn, nor with a forward command, nor from high up.
  EXPECT_FALSE(backward_headings({0.5, 0.1}, direction(-pi / 2), {1.0, 4.0}, Side::top).empty());
  EXPECT_FALSE(backward_headings({0.5, 0.1}, direction(pi / 2), tight, Side::top).empty());
  EXPECT_FALSE(backward_headings({0.5, 0.9}, direction(-pi / 2), tight, Side::top).empty());
}

TEST(BackwardHeadings, EmptySetsOccurForBackwardCommandsOnly) {
  Random random(59);
  int empty = 0;
  for (int draw = 0; draw < 20'000; ++draw) {
    const CellShape shape{1.0, random.uniform(1.0 + 1e-9, 1.3)};
    const Vec2 p{random.unit(), random.unit()};
    const double command = random.uniform(-pi, pi);
    const HeadingSet set = backward_headings(p, direction(command), shape, Side::top);
    if (set.empty()) {
      ++empty;
      EXPECT_LT(command, 0.0);
    }
  }
  EXPECT_GT(empty, 20);
}

TEST(BackwardHeadings, ForABackwardCommandCloseAroundTheOppositeHeading) {
  // Seen from the centre the range contains the heading opposite to the command, where left turns
  // begin and right turns end (the second interval of Fig. 7).
  const HeadingSet set = backward_headings({0.5, 0.5}, direction(-pi / 2), {1.0, 3.0}, Side::top);
  ASSERT_EQ(set.count, 1U);
  EXPECT_NEAR(set.ranges[0].middle_rad(), pi / 2, 1e-12);
}

TEST(BackwardHeadings, BackToTheBorderOfEntryAreSplitInTwo) {
  const CellShape shape{1.0, 2.5};
  const HeadingSet set =
      backward_headings_on_border(Side::bottom, 0.4, direction(-pi / 2), shape, Side::bottom);
  ASSERT_EQ(set.count, 2U);
  // Chords: 2 r sin(angle) is the way to the corner.
  const double to_right = std::asin(0.6 / 5.0);
  const double to_left = std::asin(0.4 / 5.0);
  EXPECT_TRUE(set.holds(0.5 * to_right));
  EXPECT_FALSE(set.holds(to_right + 1e-9));
  EXPECT_TRUE(set.holds(pi - 0.5 * to_left));
  EXPECT_FALSE(set.holds(pi - to_left - 1e-9));
  EXPECT_FALSE(set.holds(-0.1));  // does not enter
}

TEST(BackwardHeadings, OnBordersAreThoseThatEnter) {
  Random random(61);
  int split = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    const CellShape shape = drawn_shape(random);
    const Side entry = sides[random.below(4)];
    const double along = shape.cell_m * random.uniform(0.01, 0.99);
    const Direction command = direction(drawn_command(random));
    double width = 0.0;
    for (const Side exit : sides) {
      const HeadingSet set = backward_headings_on_border(entry, along, command, shape, exit);
      const HeadingSet all =
          backward_headings(point_on(entry, along, shape.cell_m), command, shape, exit);
      for (const HeadingRange& range : set) width += range.width_rad;
      if (set.count == 2) ++split;
      for (int k = 0; k < 64; ++k) {
        const double h = (k + 0.3) * two_pi / 64;
        const bool enters = std::sin(h - static_cast<int>(entry) * (pi / 2) - pi / 2) > 0.0;
        if (from_nearest_end(set, h) > 1e-9) {
          ASSERT_EQ(set.holds(h), enters && all.holds(h));
        }
      }
    }
    ASSERT_NEAR(width, pi, 1e-9);
  }
  EXPECT_GT(split, 100);
}

TEST(BackwardHeadings, TurnWithTheCell) {
  Random random(67);
  for (int draw = 0; draw < 2000; ++draw) {
    const CellShape shape = drawn_shape(random);
    const Vec2 p{random.uniform(0.0, shape.cell_m), random.uniform(0.0, shape.cell_m)};
    const double command = random.uniform(-pi, pi);
    const Side exit = sides[random.below(4)];
    const HeadingSet set = backward_headings(p, direction(command), shape, exit);
    const HeadingSet after = backward_headings(turned_in_cell(p, 1, shape.cell_m),
                                               direction(command + pi / 2), shape, turned(exit, 1));
    ASSERT_EQ(set.count, after.count);
    for (std::size_t i = 0; i < set.count; ++i) {
      ASSERT_NEAR(
          std::remainder(after.ranges[i].from_rad - set.ranges[i].from_rad - pi / 2, two_pi), 0.0,
          1e-7);
      ASSERT_NEAR(after.ranges[i].width_rad, set.ranges[i].width_rad, 1e-7);
    }
  }
}

TEST(BackwardHeadings, ThroughACornerAreThoseOfEquations4To6) {
  // The centres of Eq. 4 (upper sign: to the right of the way), the rotations of Eqs. 5 and 6.
  const double r = 2.5;
  const Vec2 p{0.3, 0.2};
  const Vec2 e{1.0, 1.0};
  const double q = norm(e - p);
  const double h = std::sqrt(r * r - q * q / 4) / q;
  const Vec2 right{(p.x + e.x) / 2 + (e.y - p.y) * h, (p.y + e.y) / 2 + (p.x - e.x) * h};
  const Vec2 left{(p.x + e.x) / 2 - (e.y - p.y) * h, (p.y + e.y) / 2 - (p.x - e.x) * h};
  const double by_left = std::atan2(p.y - left.y, p.x - left.x) + pi / 2;
  const double by_right = std::atan2(p.y - right.y, p.x - right.x) - pi / 2;
  // With commands far to one side the whole way is an arc.
  const HeadingSet with_left = backward_headings(p, direction(2.5), {1.0, r}, Side::top);
  const HeadingSet with_right = backward_headings(p, direction(-0.5), {1.0, r}, Side::top);
  ASSERT_EQ(with_left.count, 1U);
  ASSERT_EQ(with_right.count, 1U);
  EXPECT_NEAR(std::remainder(with_left.ranges[0].from_rad - by_left, two_pi), 0.0, 1e-12);
  EXPECT_NEAR(std::remainder(with_right.ranges[0].from_rad - by_right, two_pi), 0.0, 1e-12);
}

TEST(BackwardHeadings, ThroughACornerAndStraightAreThoseOfEquations8To10Corrected) {
  // Eq. 9 for a point above the line: its root is right for commands heading east, and the printed
  // atan2 is already rotated by a quarter turn: no further pi / 2.
  const double d = 1.0;
  const double r = 2.5;
  const double c = 0.9;
  const Vec2 p{0.2, 0.25};
  const double m = std::tan(c);
  const double q = (1.0 - m) * d;
  ASSERT_GT(p.y, m * p.x + q);  // region A
  const double qp = q + r / std::abs(std::sin(pi / 2 - c));
  const double beta = (2 * m * qp - 2 * p.x - 2 * m * p.y) / (1 + m * m);
  const double gamma = (p.x * p.x + p.y * p.y + qp * qp - 2 * p.y * qp - r * r) / (1 + m * m);
  const double center_x = (-beta + std::sqrt(beta * beta - 4 * gamma)) / 2;
  const double printed = std::atan2(p.x - center_x, (m * center_x + qp) - p.y);
  const HeadingSet set = backward_headings(p, direction(c), {d, r}, Side::top);
  ASSERT_EQ(set.count, 1U);
  const double from = set.ranges[0].from_rad;
  EXPECT_NEAR(std::remainder(from - printed, two_pi), 0.0, 1e-12);
  EXPECT_GT(std::abs(std::remainder(from - printed - pi / 2, two_pi)), 1.0);
}

TEST(BackwardHeadings, ThroughTheLeftCornerTakeTheOtherRootOfEquation9) {
  // The end of the left turn lies ahead of p: to the west, when the command heads west.
  const double d = 1.0;
  const double r = 2.5;
  const double c = 2.0;
  const Vec2 p{0.3, 0.2};
  const double m = std::tan(c);
  ASSERT_LT(p.y, m * p.x + d);  // region B of the line through (0, d): a left turn
  const double qp = d - r / std::abs(std::sin(pi / 2 - c));
  const double beta = (2 * m * qp - 2 * p.x - 2 * m * p.y) / (1 + m * m);
  const double gamma = (p.x * p.x + p.y * p.y + qp * qp - 2 * p.y * qp - r * r) / (1 + m * m);
  const double root = std::sqrt(beta * beta - 4 * gamma);
  const auto heading = [&](double x) { return std::atan2(p.x - x, (m * x + qp) - p.y); };
  const HeadingSet set = backward_headings(p, direction(c), {d, r}, Side::top);
  ASSERT_EQ(set.count, 1U);
  const double to = set.ranges[0].to_rad();
  EXPECT_NEAR(std::remainder(to - heading((-beta - root) / 2), two_pi), 0.0, 1e-12);
  EXPECT_GT(std::abs(std::remainder(to - heading((-beta + root) / 2), two_pi)), 0.1);  // as printed
}

TEST(BackwardHeadings, RefusePointsOutsideAndWideCells) {
  const CellShape shape{1.0, 2.0};
  EXPECT_THROW(static_cast<void>(backward_headings({1.1, 0.5}, direction(0), shape, Side::top)),
               PreconditionViolation);
  EXPECT_THROW(
      static_cast<void>(backward_headings({0.5, 0.5}, direction(0), {1.0, 1.0}, Side::top)),
      PreconditionViolation);
}

}  // namespace
}  // namespace fairway
