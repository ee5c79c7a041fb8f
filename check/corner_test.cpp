// Flights exactly through corners, and exactly along borders into them.
//
// Faults planted one at a time (motion.cpp) to see that they are caught, all by the first test:
//   at_low or at_high never set, swapped, or only set beyond the corner; what touches a corner
//   lost; flags lost for straight ways, with or without an arc or a command, for arcs to either
//   hand, for either pair of sides; ties of events lost.
// These change no reports: corners of a way that skims (the side ahead reports the same).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "check/flight.hpp"
#include "check/testing/told_flights.hpp"
#include "fairway/base/random.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway_check {
namespace {

using fairway::Heading;
using fairway::pi;
using fairway::Random;
using Exact = fairway::WideVec<Wide>;

/// A set with a state that comes exactly to the corner of cell (2, 2) on the sides `side` and
/// `towards`, which is the side after it or before it.
struct Approach {
  int side = 0;
  int towards = 1;
  int way = 0;  // 0 straight, 1 after an arc, 2 on an arc, 3 along the side `towards`, exactly
  int turn = 1;
  double heading_rad = 0.0;  // at the corner
  double back = 0.3;
  fairway::Plan plan;
  Vec at{};
  Vec heading{};
  Exact at_corner;  // the heading there

  Cell ahead() const { return Cell{2, 2}.beyond(side); }
  Cell beside() const { return Cell{2, 2}.beyond(towards); }
  Cell across() const { return ahead().beyond(towards); }
  double corner_x() const { return 0.5 * (step_x[side] + step_x[towards]); }
  double corner_y() const { return 0.5 * (step_y[side] + step_y[towards]); }
  void command(Cell c, float rad) { plan.heading_rad[plan.grid.index({c.x, c.y})] = rad; }
  std::string text() const {
    return "side " + std::to_string(side) + " towards " + std::to_string(towards) + " way " +
           std::to_string(way) + " turn " + std::to_string(turn) + " heading " +
           std::to_string(heading_rad);
  }

  /// Back from the corner; false when that is not in the cell.
  bool take_start() {
    const double r = plan.vehicle.turn_radius_m;
    if (way == 3) {
      command({2, 2}, NAN);
      at_corner = {Wide(step_x[side]), Wide(step_y[side])};
      heading = {Real(step_x[side]), Real(step_y[side])};
      at = {Real(corner_x() - 0.5 * step_x[side]), Real(corner_y() - 0.5 * step_y[side])};
      return true;
    }
    double start_rad = heading_rad;
    double k = way == 0 ? 0.0 : turn;
    command({2, 2}, way == 0   ? NAN
                    : way == 1 ? static_cast<float>(heading_rad)
                               : Heading::stored(heading_rad + 1.2 * k));
    const double straight = way == 0 ? back : way == 1 ? 0.5 * back : 0.0;
    double x = corner_x() - straight * std::cos(heading_rad);
    double y = corner_y() - straight * std::sin(heading_rad);
    if (way != 0) {
      start_rad = Heading::from_rad(heading_rad - k * (back - straight) / r).rad();
      x -= k * r * (std::sin(heading_rad) - std::sin(start_rad));
      y += k * r * (std::cos(heading_rad) - std::cos(start_rad));
    }
    at_corner = fairway::wide_unit<Wide>(heading_rad);
    const Upwards upwards;
    heading = unit_vector(start_rad);
    at = {Real(x - 1e-13, x + 1e-13), Real(y - 1e-13, y + 1e-13)};
    return cut(at.x, Real(-0.5, 0.5)) && cut(at.y, Real(-0.5, 0.5));
  }
};

Approach draw(Random& random) {
  Approach a;
  a.plan = fairway::empty_plan(5, 5, 1.0, random.uniform(1.05, 3.0));
  a.side = static_cast<int>(random.below(4));
  a.towards = (a.side + (random.below(2) == 0 ? 1 : 3)) & 3;
  a.way = static_cast<int>(random.below(4));
  a.turn = random.below(2) == 0 ? 1 : -1;
  a.back = random.uniform(0.05, 0.6);
  const double share = random.below(4) == 0 ? 0.5 : random.uniform(0.05, 0.95);
  const double out_rad = a.side * (pi / 2);
  a.heading_rad = static_cast<double>(
      Heading::stored(out_rad + share * Heading::from_rad(a.towards * (pi / 2) - out_rad).rad()));
  for (std::size_t c = 0; c < a.plan.grid.size(); ++c) {
    a.plan.heading_rad[c] = random.below(5) == 0 ? 0.0F : Heading::stored(random.uniform(-pi, pi));
  }
  for (const Cell c : {a.beside(), a.ahead(), a.across()}) {
    static constexpr std::array<fairway::Region, 3> regions{
        fairway::Region::free, fairway::Region::obstacle, fairway::Region::goal};
    a.plan.region[a.plan.grid.index({c.x, c.y})] = regions[random.below(regions.size())];
  }
  return a;
}

TEST(CheckCorner, EveryCellAroundACornerIsReportedAndTheOneAcrossEntered) {
  Random random = Random::stream(11, 1);
  int told_of = 0;
  int entered = 0;
  int lost = 0;
  for (int i = 0; i < 12000; ++i) {
    Approach a = draw(random);
    if (!a.take_start()) continue;
    const fairway::PlanFlow owner(a.plan);
    const fairway::Flow flow = owner.flow();
    const Loop loop = loop_of(flow);
    Told told;
    {
      const Upwards upwards;
      follow_states(loop, loop.index({2, 2}), a.at, a.heading, told);
    }
    if (told.lost) {
      ++lost;
      continue;
    }
    const double least = a.way == 3 ? 0.5 : a.back * (1.0 - 1e-10);
    for (const Cell c : {a.beside(), a.ahead(), a.across()}) {
      const CellKind kind = loop.kind_at(c);
      if (kind == ordinary) continue;
      ++told_of;
      const bool found = std::any_of(told.ends.begin(), told.ends.end(), [&](const auto& end) {
        const bool long_enough = (end.second >= least && end.second <= 1.04 * least + 1e-6) ||
                                 // next to the border that it runs along: before
                                 (a.way == 3 && c.x == a.beside().x && c.y == a.beside().y);
        return end.first == (kind == target ? reach : collide) && long_enough;
      });
      ASSERT_TRUE(found) << a.text() << " cell " << c.x << "," << c.y;
    }
    const Cell c = a.across();
    if (loop.kind_at(c) != ordinary) continue;
    const fairway::WideCommands<Wide> commands(flow);
    const Exact& command = commands.unit[loop.index(c)];
    const Wide over = Wide(step_x[a.towards]) * command.x + Wide(step_y[a.towards]) * command.y;
    if (a.way == 3 && over < 0) continue;  // turned back at once
    const Exact p{Wide(0.5 - a.corner_x()), Wide(0.5 - a.corner_y())};
    fairway::WideFlight<Wide> flight(commands, c.x, c.y, p, a.at_corner,
                                     [&random](std::size_t n) { return random.below(n); });
    auto met = flight.fly(3000);
    if (met.section == fairway::WideMeeting<Wide>::none && met.end == fairway::Verdict::undecided) {
      continue;
    }
    ++entered;
    met.length_m += static_cast<long double>(least);
    ASSERT_TRUE(told.knows_of(met, 1.0))
        << a.text() << " meets section " << met.section << " or ends with " << name_of(met.end);
  }
  EXPECT_GT(told_of, 8000);
  EXPECT_GT(entered, 1200);
  EXPECT_LT(lost, 1200);
}

/// Away from a corner nothing is known about the cells beyond it.
TEST(CheckCorner, NothingIsReportedForTheCellNextToACornerThatIsMissed) {
  Random random = Random::stream(11, 2);
  int missed = 0;
  for (int i = 0; i < 10000; ++i) {
    Approach a = draw(random);
    if (a.way == 3) continue;
    for (const Cell c : {a.beside(), a.ahead(), a.across()}) {
      a.plan.region[a.plan.grid.index({c.x, c.y})] = fairway::Region::free;
      a.command(c, static_cast<float>(a.heading_rad));
    }
    if (!a.take_start()) continue;
    const Cell b = a.beside();
    a.plan.region[a.plan.grid.index({b.x, b.y})] = fairway::Region::obstacle;
    const double off = std::exp2(-random.uniform(5.0, 35.0));
    const fairway::PlanFlow owner(a.plan);
    const Loop loop = loop_of(owner.flow());
    Told told;
    {
      const Upwards upwards;
      a.at = {a.at.x - off * step_x[a.towards], a.at.y - off * step_y[a.towards]};
      if (!cut(a.at.x, Real(-0.5, 0.5)) || !cut(a.at.y, Real(-0.5, 0.5))) continue;
      follow_states(loop, loop.index({2, 2}), a.at, a.heading, told);
    }
    if (told.lost) continue;
    ++missed;
    for (const auto& [verdict, length] : told.ends) {
      ASSERT_FALSE(verdict == collide && length <= 1.04 * a.back + 1e-6)
          << a.text() << " off " << off;
    }
  }
  EXPECT_GT(missed, 4000);
}

}  // namespace
}  // namespace fairway_check
