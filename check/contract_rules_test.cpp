#include "check/contract_rules.hpp"

#include <gtest/gtest.h>

#include "check/testing/contract_adversary.hpp"

namespace fairway_check {
namespace {

using std::numbers::pi;

constexpr double degree = pi / 180.0;

Contract ordinary_contract() {
  return {.command_error = 0.0,
          .heading_error = 0.0,
          .estimate_error = 0.0,
          .least_radius = 9.0,
          .most_radius = 11.0,
          .least_speed = 1.0,
          .most_speed = 1.0,
          .hold_side = 90.0 * degree,
          .side_uncertain = 5.0 * degree};
}

/// What those that turn left with heading 0 may do; the arc begins at `right` degrees.
Choices choices_at_zero(double right, double width, Memory memory) {
  return choices_in(right * degree, width * degree, 0.0, 1.0 * degree, memory, ordinary_contract());
}

bool contains(const Shape& shape, Point p, double slack) {
  const auto c = shape.corners();
  for (std::size_t i = 0; c.size() > 2 && i < c.size(); ++i) {
    const Point edge = c[(i + 1) % c.size()] - c[i];
    if (cross(edge, p - c[i]) < -slack * std::hypot(edge.x, edge.y)) return false;
  }
  return !shape.empty();
}

Shape random_shape(std::mt19937_64& random, double size) {
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  Shape all{{size * unit(), size * unit()}};
  const int corners = 3 + static_cast<int>(random() % 20);
  for (int i = 0; i < corners; ++i) all = hull(all, Shape{{size * unit(), size * unit()}});
  return all;
}

/// Somewhere in it.
Point drawn(const Shape& shape, std::mt19937_64& random) {
  Point p{0.0, 0.0};
  double sum_of_weights = 0.0;
  for (const Point c : shape.corners()) {
    const double weight = -std::log(static_cast<double>(random() >> 11) * 0x1p-53 + 1e-300);
    p = p + weight * c;
    sum_of_weights += weight;
  }
  return 1.0 / sum_of_weights * p;
}

TEST(Shapes, SumsHullsAndClippedShapesHoldAllThatTheyShould) {
  std::mt19937_64 random(5);
  for (int n = 0; n < 3000; ++n) {
    const Shape a = random_shape(random, 3.0);
    const Shape b = n % 5 == 0 ? Shape{{0.0, 0.0}, {1.0, 0.0}} : random_shape(random, 1.0);
    const Shape both = sum(a, b, {0.5, -0.5});
    const Shape around = hull(a, b);
    const Box box{0.5, 0.25, 2.0, 1.5};
    const Shape cut = clipped(a, box);
    for (int i = 0; i < 10; ++i) {
      const Point p = drawn(a, random);
      const Point q = drawn(b, random);
      ASSERT_TRUE(contains(both, p + q + Point{0.5, -0.5}, 1e-12));
      ASSERT_TRUE(contains(around, 0.3 * p + 0.7 * q, 1e-12));
      const bool inside = p.x > box.x0 && p.x < box.x1 && p.y > box.y0 && p.y < box.y1;
      ASSERT_TRUE(!inside || contains(cut, p, 1e-12));
    }
    for (const Point p : cut.corners()) {
      ASSERT_TRUE(contains(a, p, 1e-12));
      ASSERT_TRUE(p.x >= box.x0 && p.x <= box.x1 && p.y >= box.y0 && p.y <= box.y1);
    }
  }
}

/// Boxes that hold shapes, lie in them, cross them and lie beside them.
TEST(Shapes, MeetABoxWhereAPartOfThemIsLeftInIt) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> low(-3.0, 6.0);
  std::uniform_real_distribution<double> size(0.01, 4.0);
  int met = 0;
  for (int n = 0; n < 3000; ++n) {
    const Shape a = n % 7 == 0 ? Shape{{1.0, 1.0}} : random_shape(random, 3.0);
    const double x = low(random);
    const double y = low(random);
    const Box box{x, y, x + size(random), y + size(random)};
    bool in_box = false;
    for (int i = 0; i < 20; ++i) {
      const Point p = drawn(a, random);
      in_box = in_box || (p.x > box.x0 && p.x < box.x1 && p.y > box.y0 && p.y < box.y1);
    }
    ASSERT_EQ(meets(a, box), !clipped(a, box).empty());
    ASSERT_TRUE(!in_box || meets(a, box));
    met += meets(a, box) ? 1 : 0;
  }
  EXPECT_GT(met, 300);
  EXPECT_LT(met, 2700);
}

TEST(Angles, AroundFromDiffersByWholeTurnsAndIsNeverNegativeButForTheSlack) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> angle(-40.0, 40.0);
  for (int n = 0; n < 10000; ++n) {
    const double from = n % 3 == 0 ? 2.0 * pi * (n % 11 - 5) + (n % 5 - 2) * 1e-9 : angle(random);
    const double to = around_from(from);
    ASSERT_GE(to, -angle_slack);
    ASSERT_LE(to, 2.0 * pi - angle_slack);
    ASSERT_NEAR(std::remainder(from - to, 2.0 * pi), 0.0, 1e-13);
  }
}

TEST(Shapes, ManySumsStayConvexAndSimple) {
  std::mt19937_64 random(6);
  Shape all{{0.0, 0.0}};
  Point reached{0.0, 0.0};
  for (int n = 0; n < 2000; ++n) {
    const Shape piece = random_shape(random, 0.01);
    reached = reached + drawn(piece, random);
    all = sum(all, piece);
    ASSERT_LE(all.count(), Shape::most - 32 + 64);
    ASSERT_TRUE(contains(all, reached, 1e-9));
  }
}

TEST(Choices, ANearCommandIsTurnedToThroughTheSmallerAngle) {
  const Choices left = choices_at_zero(30.0, 20.0, {.nothing = true, .side = false});
  EXPECT_TRUE(left.goes_on && !left.turns_back && !left.aligns && !left.alternates);
  EXPECT_TRUE(left.on.nothing && !left.on.side);
  const Choices right = choices_at_zero(-50.0, 20.0, {.nothing = true, .side = true});
  EXPECT_TRUE(!right.goes_on && right.turns_back && !right.alternates);
}

TEST(Choices, AFarCommandKeepsTheSideTaken) {
  const Choices held = choices_at_zero(-150.0, 20.0, {.nothing = false, .side = true});
  EXPECT_TRUE(held.goes_on && !held.turns_back && held.on.side && !held.on.nothing);
  const Choices free = choices_at_zero(-150.0, 20.0, {.nothing = true, .side = false});
  EXPECT_TRUE(!free.goes_on && free.turns_back && free.back.side);
}

TEST(Choices, OppositeEitherSideMayBeTaken) {
  for (const double off : {-4.0, 0.0, 4.0}) {
    const Choices c = choices_at_zero(180.0 + off, 0.0, {.nothing = true, .side = false});
    EXPECT_TRUE(c.goes_on && c.turns_back && !c.alternates) << off;
  }
  EXPECT_FALSE(choices_at_zero(173.0, 0.0, {.nothing = true, .side = false}).turns_back);
  EXPECT_FALSE(choices_at_zero(187.0, 0.0, {.nothing = true, .side = false}).goes_on);
}

TEST(Choices, ANearCommandOnOneSideAndAFarOneOnTheOtherAlternate) {
  // 80 degrees to the left up to 200 to the left, which is 160 to the right.
  const Choices c = choices_at_zero(80.0, 120.0, {.nothing = true, .side = false});
  EXPECT_TRUE(c.alternates);
}

TEST(Choices, AHeldSideMayLeadOutOfAWideArc) {
  const Memory held{.nothing = false, .side = true};
  EXPECT_TRUE(choices_at_zero(-95.0, 110.0, held).goes_on);
  EXPECT_FALSE(choices_at_zero(-85.0, 110.0, held).goes_on);
  EXPECT_FALSE(choices_at_zero(-95.0, 110.0, {.nothing = true, .side = false}).goes_on);
}

TEST(Choices, ArcsThatBehavioursMayTurnOutOfAreLoose) {
  Contract contract = ordinary_contract();
  EXPECT_FALSE(is_loose({0.0, 174.0 * degree}, contract));
  EXPECT_TRUE(is_loose({0.0, 176.0 * degree}, contract));
  EXPECT_TRUE(is_loose({0.0, 190.0 * degree}, contract));
  contract.hold_side = 40.0 * degree;
  EXPECT_TRUE(is_loose({0.0, 81.0 * degree}, contract));
  EXPECT_FALSE(is_loose({0.0, 79.0 * degree}, contract));
}

TEST(WaysOut, HoldEveryCurveWithHeadingsInTheCone) {
  std::mt19937_64 random(7);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  int left = 0;
  for (int n = 0; n < 3000; ++n) {
    const Shape at = clipped(random_shape(random, 1.4), {0.0, 0.0, 1.0, 1.0});
    if (at.empty()) continue;
    const double least = 2.0 * pi * unit();
    const double most = least + (n % 4 == 0 ? 0.0 : 3.1 * unit());
    for (int f = 0; f < 10; ++f) {
      Point p = drawn(at, random);
      int side = -1;
      while (side < 0) {
        const double heading = least + (most - least) * std::clamp(1.4 * unit() - 0.2, 0.0, 1.0);
        const Point step = 0.2 * unit() * Point{std::cos(heading), std::sin(heading)};
        const Point next = p + step;
        double part = 1.0;
        const auto meet = [&](double from, double to, double line, int at_side) {
          if ((to - line) * (at_side < 2 ? 1.0 : -1.0) <= 0.0 || to == from) return;
          if (const double now = (line - from) / (to - from); now < part) {
            part = now;
            side = at_side;
          }
        };
        meet(p.x, next.x, 1.0, 0);
        meet(p.y, next.y, 1.0, 1);
        meet(p.x, next.x, 0.0, 2);
        meet(p.y, next.y, 0.0, 3);
        p = p + part * step;
      }
      const double place = side == 0 ? p.y : side == 1 ? 1.0 - p.x : side == 2 ? 1.0 - p.y : p.x;
      double low = 0.0;
      double high = 0.0;
      ASSERT_TRUE(find_way_out(at, side, least, most, false, low, high)) << n;
      ASSERT_TRUE(low <= place + 1e-9 && place <= high + 1e-9) << n << " " << place;
      ++left;
    }
  }
  EXPECT_GT(left, 10000);
}

TEST(ContractParts, CellsWithoutACommandHaveThatOfTheNearestInTheArraysOrder) {
  std::mt19937_64 random(8);
  for (int n = 0; n < 300; ++n) {
    SmallWorld w;
    w.nx = 1 + static_cast<int>(random() % 9);
    w.ny = 1 + static_cast<int>(random() % 9);
    const bool sparse = random() % 2 == 0;
    for (int i = 0; i < w.nx * w.ny; ++i) {
      w.command.push_back(random() % (sparse ? 12 : 2) == 0 ? static_cast<float>(i) * 0.01F : NAN);
    }
    w.fill();
    const std::vector<float> found = filled(w.command, w.nx, w.ny);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (std::isnan(w.filled[i])) {
        ASSERT_TRUE(std::isnan(found[i]));
      } else {
        ASSERT_EQ(static_cast<double>(found[i]), w.filled[i]) << n << " " << i;
      }
    }
  }
}

TEST(ContractParts, AnArcHoldsTheCommandsOfAllCellsWithinTheErrorAndLittleMore) {
  std::mt19937_64 random(9);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  int narrow = 0;
  for (int n = 0; n < 200; ++n) {
    SmallWorld w;
    w.nx = w.ny = 6;
    w.k = 1 + static_cast<int>(random() % 4);
    for (int i = 0; i < 36; ++i) {
      w.command.push_back(static_cast<float>(wrapped(3.0 + 2.0 * unit() * (n % 3))));
      w.kind.push_back(0);
    }
    w.fill();
    w.rho = n % 4 == 0 ? 0.0 : n % 4 == 1 ? w.k : 2.5 * w.k * unit();
    w.eps = 0.1 * unit();
    Contract contract = ordinary_contract();
    contract.command_error = w.rho;
    contract.heading_error = w.eps;
    Loop loop;
    loop.nx = w.nx;
    loop.ny = w.ny;
    loop.command_rad = w.command;
    loop.kind = w.kind;
    const Parts parts = parts_of(loop, w.k, w.k, contract);
    for (std::size_t i = 0; i < parts.kind.size(); ++i) {
      double right = 0.0;
      double width = 0.0;
      w.arc_of(parts.part_at(i).x, parts.part_at(i).y, right, width);
      if (width >= pi) {
        ASSERT_GE(parts.arc[i].width, pi);
        continue;
      }
      ++narrow;
      ASSERT_GE(parts.arc[i].width, width);
      ASSERT_LT(parts.arc[i].width, width + 1e-6);
      ASSERT_LT(std::abs(wrapped(parts.arc[i].right - right)), 1e-6);
    }
  }
  EXPECT_GT(narrow, 10000);
}

}  // namespace
}  // namespace fairway_check
