// Flights through corners, and within cell_m / 2^34 of them, on purpose.
//
// Faults planted one at a time to see that they are caught (section_flight.hpp,
// cell_enclosure.hpp), and by which test:
//   low, high corner not reported, or swapped; only by the sole side, or only by one of several;
//     of arcs, of turned-to commands, of sides across or along, of ends at targets, left out: A
//   the cell next to it, or across, not reported, or on the wrong side: A
//   an obstacle next to it not reported where a target lies across: A
//   onwards test reversed, one-sided, or strict at 0: A
//   onwards test dropped: B
//   the cell across not entered, or at a wrong place: A
//   turning back whatever the heading, or along the border: A
//   turning back over the border in it: C
//   turning back not seen: E
//   reach of the corner 0; what lies at a corner lost: A
//   flags of arcs or of straight departures lost, at either end: A
//   flags lost for states that already turn, or hop: D
//   the cell beyond a border run along not followed: C
// A ReportsEveryCellAroundACorner..., B ReportsNothingForTheCellNextToACorner...,
// C FollowsAHeadingAlongABorder..., D ReportsTheCornerWhereAHop..., E IsNotLostInCells...
// These change no reports: the grid's outside reported for one of two cells (the other is outside,
// too); corners of a departure that grazes (the side ahead reports the same).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "fairway/base/random.hpp"
#include "fairway/verify/section_flight.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/testing/told_flights.hpp"

namespace fairway {
namespace {

using Vec = WideVec<Wide>;
using section_flight::opposite;
using section_flight::step_x;
using section_flight::step_y;

constexpr int most_crossings = 3000;

Cell beyond(Cell c, Side s) { return {c.ix + step_x(s), c.iy + step_y(s)}; }
Verdict verdict_of(CellKind kind) {
  return kind == CellKind::target     ? Verdict::reach
         : kind == CellKind::obstacle ? Verdict::collide
                                      : Verdict::leave;
}

/// How the vehicle comes to the corner.
enum class Way { silent, aligned, after_arc, left_arc, right_arc };

/// A state that leaves its cell by `side`, `off` cells before the end of the side that is at
/// `towards`, as accurately as doubles allow.
struct Approach {
  Way way = Way::silent;
  Side side = Side::right;
  Side towards = Side::top;
  double off = 0.0;
  double heading_rad = 0.0;  ///< there
  double back = 0.3;         ///< how far before, in cells
  double slack = 0.0;        ///< of the components of the heading reported

  Cell cell{2, 2};
  Plan plan;
  Vec2 start_m{};
  double start_rad = 0.0;

  std::string text() const {
    return "way " + std::to_string(static_cast<int>(way)) + " side " +
           std::to_string(static_cast<int>(side)) + " towards " +
           std::to_string(static_cast<int>(towards)) + " off 2^" +
           std::to_string(off > 0.0 ? std::log2(off) : -999.0) + " heading " +
           std::to_string(heading_rad) + " back " + std::to_string(back);
  }
  Vec2 corner_m() const {
    const double d = plan.grid.cell_m;
    const bool right = side == Side::right || towards == Side::right;
    const bool top = side == Side::top || towards == Side::top;
    return {right ? d : 0.0, top ? d : 0.0};
  }
  Cell beside() const { return beyond(cell, towards); }
  Cell ahead() const { return beyond(cell, side); }
  Cell across() const { return beyond(ahead(), towards); }
  void command(double rad) { plan.heading_rad[plan.grid.index(cell)] = Heading::stored(rad); }

  /// Back from the corner; false when the start is not in the cell.
  bool take_start() {
    const double d = plan.grid.cell_m;
    const double r = plan.vehicle.turn_radius_m;
    const Vec2 u = heading_rad == pi        ? Vec2{-1.0, 0.0}
                   : heading_rad == pi / 2  ? Vec2{0.0, 1.0}
                   : heading_rad == -pi / 2 ? Vec2{0.0, -1.0}
                                            : Heading::from_rad(heading_rad).unit();
    const Vec2 q = corner_m() - (off * d) * Vec2{1.0 * step_x(towards), 1.0 * step_y(towards)};
    start_rad = heading_rad;
    start_m = q - (back * d) * u;
    double k = 0.0;
    if (way == Way::silent) plan.heading_rad[plan.grid.index(cell)] = NAN;
    if (way == Way::aligned) {
      command(heading_rad);
    } else if (way == Way::after_arc) {
      command(heading_rad);  // reached halfway
      k = back > 0.3 ? 1.0 : -1.0;
      start_m = q - (0.5 * back * d) * u;
    } else if (way == Way::left_arc || way == Way::right_arc) {
      k = way == Way::left_arc ? 1.0 : -1.0;
      start_m = q;
      command(heading_rad + k * 1.2);
    }
    if (k != 0.0) {
      const double turned = (way == Way::after_arc ? 0.5 : 1.0) * back * d / r;
      start_rad = Heading::from_rad(heading_rad - k * turned).rad();
      const Vec2 v = Heading::from_rad(start_rad).unit();
      start_m = start_m - (k * r) * Vec2{u.y - v.y, v.x - u.x};
    }
    return start_m.x >= 0.0 && start_m.x <= d && start_m.y >= 0.0 && start_m.y <= d;
  }
  Front front() const {
    Front front;
    front.ix = cell.ix;
    front.iy = cell.iy;
    front.entry.position_m = {start_m.x, start_m.y};
    const Interval around{-slack, slack};
    front.entry.heading = unit_enclosure(start_rad);
    if (slack > 0.0) {
      front.entry.heading = {intersection(front.entry.heading.x + around, {-1.0, 1.0}),
                             intersection(front.entry.heading.y + around, {-1.0, 1.0})};
    } else if (start_rad == pi || std::abs(start_rad) == pi / 2) {  // the axis itself
      front.entry.heading = {std::round(std::cos(start_rad)), std::round(std::sin(start_rad))};
    }
    if (way == Way::aligned) front.heading_rad = plan.heading_rad[plan.grid.index(cell)];
    return front;
  }
};

Approach draw(Random& random) {
  static constexpr std::array<double, 7> offs{0.0,     0.0,     0x1p-36, 0x1p-36,
                                              0x1p-38, 0x1p-42, 0x1p-46};
  Approach a;
  const double d = random.below(2) == 0 ? 1.0 : 4.0;
  a.plan = empty_plan(5, 5, d, d * random.uniform(1.05, 3.0));
  a.cell = {static_cast<int>(random.below(5)), static_cast<int>(random.below(5))};
  a.way = static_cast<Way>(random.below(5));
  a.side = static_cast<Side>(random.below(4));
  a.towards = static_cast<Side>((static_cast<int>(a.side) + (random.below(2) == 0 ? 1 : 3)) & 3);
  a.off = offs[random.below(offs.size())];
  a.back = random.uniform(0.05, 0.6);
  const double out_rad = static_cast<double>(a.side) * (pi / 2);
  const double end_rad = static_cast<double>(a.towards) * (pi / 2);
  const double turn = Heading::from_rad(end_rad - out_rad).rad();  // +-90 degrees
  const double straight_out = Heading::from_rad(out_rad).rad();
  double h = 0.0;
  switch (random.below(4)) {
    case 0:  // straight out: along the border across
      h = straight_out;
      break;
    case 1:  // almost
      h = Heading::from_rad(out_rad + std::copysign(0x1p-22, turn)).rad();
      break;
    default:
      h = Heading::from_rad(out_rad + random.uniform(0.05, 0.95) * turn).rad();
  }
  // As a command it is a float; the axes except 0 are not.
  if (a.way == Way::aligned || a.way == Way::after_arc) {
    h = static_cast<double>(Heading::stored(h));
  }
  a.heading_rad = h;
  if (random.below(3) == 0) a.slack = 0x1p-50;
  for (std::size_t c = 0; c < a.plan.grid.size(); ++c) {
    a.plan.heading_rad[c] =
        Heading::stored(random.below(3) == 0 ? static_cast<double>(random.below(4)) * (pi / 2)
                                             : random.uniform(-pi, pi));
  }
  for (const Cell c : {a.beside(), a.ahead(), a.across()}) {
    if (!a.plan.grid.contains(c)) continue;
    static constexpr std::array<Region, 3> regions{Region::free, Region::obstacle, Region::goal};
    a.plan.region[a.plan.grid.index(c)] = regions[random.below(regions.size())];
  }
  return a;
}

/// The exact path of the approach's state through its cell.
WideExits<Wide> exact_exits(const Approach& a) {
  const WideCell<Wide> cell(a.plan.grid.cell_m, a.plan.vehicle.turn_radius_m);
  const Vec p{Wide(a.start_m.x), Wide(a.start_m.y)};
  const Vec u = wide_unit<Wide>(a.start_rad);
  const float rad = a.plan.heading_rad[a.plan.grid.index(a.cell)];
  WideExits<Wide> exits;
  if (std::isnan(rad) || a.way == Way::aligned) {
    WideExit<Wide> exit;
    exit.aligned = !std::isnan(rad);
    cell.straight(p, u, exit, exits);
    return exits;
  }
  const Vec c = wide_unit<Wide>(static_cast<double>(rad));
  return cell.turning(p, u, c, WideCell<Wide>::turn_of(u, c));
}

/// Whether an end of this kind is reported within the length to the corner.
bool tells_end(const Told& told, CellKind kind, long double length_m) {
  for (const Told::End& end : told.ends) {
    if (end.verdict == verdict_of(kind) &&
        static_cast<long double>(end.length_m) >= length_m * (1.0L - 1e-14L) &&
        static_cast<long double>(end.length_m) <= length_m * 1.04L + 1e-6L) {
      return true;
    }
  }
  return false;
}

TEST(CornerFlight, ReportsEveryCellAroundACornerThatIsPassedWithinItsReach) {
  Random random(1);
  int passed = 0;
  int entered = 0;
  int given_up = 0;
  std::array<int, 5> by_way{};
  for (int i = 0; i < 40000; ++i) {
    Approach a = draw(random);
    if (!a.take_start()) continue;
    const PlanFlow plan_flow(a.plan);
    const Flow flow = plan_flow.flow();
    if (flow.kind_at(a.cell) != CellKind::ordinary) continue;
    const double d = flow.grid.cell_m;
    const WideExits<Wide> exits = exact_exits(a);
    Told told;
    follow_to_section(flow, a.front(), most_crossings, told);
    if (told.gave_up) {
      ++given_up;
      continue;
    }
    for (std::size_t e = 0; e < exits.count; ++e) {
      const WideExit<Wide>& exit = exits.of[e];
      const Vec corner{Wide(a.corner_m().x), Wide(a.corner_m().y)};
      const Vec off = corner - exit.p;
      const Wide onwards = WideCell<Wide>::outward(exit.u, a.towards);
      if (exit.side != a.side || abs(off.x) + abs(off.y) > Wide(d * 0x1p-35) || onwards < 0) {
        continue;
      }
      ++passed;
      ++by_way[static_cast<std::size_t>(a.way)];
      for (const Cell c : {a.beside(), a.ahead(), a.across()}) {
        const CellKind kind = flow.kind_at(c);
        if (kind == CellKind::ordinary) continue;
        ASSERT_TRUE(tells_end(told, kind, exit.length))
            << a.text() << ": not told " << name_of(verdict_of(kind)) << " of cell " << c.ix << ","
            << c.iy << " from " << a.cell.ix << "," << a.cell.iy << told.text();
      }
      // It continues in the cell across, as if through the corner itself, except in one whose
      // command turns back over the border that it runs along.
      const Cell c = a.across();
      if (flow.kind_at(c) != CellKind::ordinary) continue;
      const WideCommands<Wide> commands(flow);
      const Vec& command = commands.unit[flow.grid.index(c)];
      if (onwards == 0 && WideCell<Wide>::outward(command, a.towards) < 0) continue;
      ++entered;
      const Vec p{Wide(a.side == Side::left || a.towards == Side::left ? d : 0.0),
                  Wide(a.side == Side::bottom || a.towards == Side::bottom ? d : 0.0)};
      WideFlight<Wide> flight(commands, c.ix, c.iy, p, exit.u,
                              [&](std::size_t n) { return random.below(n); });
      auto met = flight.fly(300);
      if (met.section == WideMeeting<Wide>::none && met.end == Verdict::undecided) continue;
      met.length_m += exit.length;
      ASSERT_TRUE(told.has(met)) << a.text() << ": met " << text_of(met) << told.text();
    }
  }
  EXPECT_GT(passed, 12000);
  EXPECT_GT(entered, 3000);
  EXPECT_LT(given_up, 2000);
  for (const int count : by_way) EXPECT_GT(count, 800);
}

TEST(CornerFlight, ReportsNothingForTheCellNextToACornerThatIsMissed) {
  Random random(2);
  int missed = 0;
  for (int i = 0; i < 20000; ++i) {
    Approach a = draw(random);
    a.cell = {1 + static_cast<int>(random.below(3)), 1 + static_cast<int>(random.below(3))};
    a.off = std::exp2(-random.uniform(6.0, 32.0));
    const auto command = Heading::stored(a.heading_rad);
    for (const Cell c : {a.beside(), a.ahead(), a.across()}) {
      a.plan.region[a.plan.grid.index(c)] = Region::free;
      a.plan.heading_rad[a.plan.grid.index(c)] = command;
    }
    if (!a.take_start()) continue;
    a.plan.region[a.plan.grid.index(a.beside())] = Region::obstacle;
    if (random.below(2) == 0) {
      a.plan.region[a.plan.grid.index(a.ahead())] = Region::goal;
      a.plan.region[a.plan.grid.index(a.across())] = Region::obstacle;
    }
    const PlanFlow plan_flow(a.plan);
    Told told;
    follow_to_section(plan_flow.flow(), a.front(), most_crossings, told);
    const WideExits<Wide> exits = exact_exits(a);
    if (told.gave_up || exits.count != 1 || exits.first().side != a.side) continue;
    ++missed;
    ASSERT_FALSE(tells_end(told, CellKind::obstacle, exits.first().length))
        << a.text() << told.text();
  }
  EXPECT_GT(missed, 10000);
}

TEST(CornerFlight, FollowsAHeadingAlongABorderInTheCellBeyondItToo) {
  Random random(3);
  int followed = 0;
  int given_up = 0;
  for (int i = 0; i < 6000; ++i) {
    Plan plan = empty_plan(5, 5, 1.0, random.uniform(1.05, 3.0));
    for (std::size_t c = 0; c < plan.grid.size(); ++c) {
      plan.heading_rad[c] = random.below(4) == 0   ? NAN
                            : random.below(4) == 0 ? 0.0F
                                                   : Heading::stored(random.uniform(-pi, pi));
      if (random.below(5) == 0)
        plan.region[c] = random.below(2) == 0 ? Region::goal : Region::obstacle;
    }
    const Cell cell{1 + static_cast<int>(random.below(3)), 1 + static_cast<int>(random.below(3))};
    const auto border = static_cast<Side>(random.below(4));
    const auto towards =
        static_cast<Side>((static_cast<int>(border) + (random.below(2) == 0 ? 1 : 3)) & 3);
    const Cell other = beyond(cell, border);
    const std::size_t here = plan.grid.index(cell);
    plan.region[here] = Region::free;
    plan.heading_rad[here] = towards == Side::right && random.below(2) == 0 ? 0.0F : NAN;
    const PlanFlow plan_flow(plan);
    const Flow flow = plan_flow.flow();
    const double line = cell_enclosure::line_of(border, 1.0);
    const double place =
        random.below(3) == 0 ? cell_enclosure::line_of(opposite(towards), 1.0) : random.unit();
    Front front;
    front.ix = cell.ix;
    front.iy = cell.iy;
    front.entry.position_m = cell_enclosure::from_parts(line, place, border);
    front.entry.heading = {static_cast<double>(step_x(towards)),
                           static_cast<double>(step_y(towards))};
    if (towards == Side::right) front.heading_rad = 0.0F;
    Told told;
    follow_to_section(flow, front, most_crossings, told);
    if (told.gave_up) {
      ++given_up;
      continue;
    }
    WideMeeting<Wide> met;
    const CellKind kind = flow.kind_at(other);
    if (kind != CellKind::ordinary) {
      met.end = verdict_of(kind);
    } else {
      const WideCommands<Wide> commands(flow);
      const std::size_t there = flow.grid.index(other);
      const bool silent = std::isnan(flow.heading_rad[there]);
      if (!silent && WideCell<Wide>::outward(commands.unit[there], border) < 0) continue;
      const Vec u{Wide(step_x(towards)), Wide(step_y(towards))};
      const Wide start(1.0 - line);
      const bool vertical = cell_enclosure::is_vertical(border);
      const Vec p{vertical ? start : Wide(place), vertical ? Wide(place) : start};
      WideFlight<Wide> flight(commands, other.ix, other.iy, p, u,
                              [&](std::size_t n) { return random.below(n); });
      met = flight.fly(300);
      if (met.section == WideMeeting<Wide>::none && met.end == Verdict::undecided) continue;
    }
    ++followed;
    ASSERT_TRUE(told.has(met)) << "cell " << cell.ix << "," << cell.iy << " border "
                               << static_cast<int>(border) << " towards "
                               << static_cast<int>(towards) << " at " << place << ": met "
                               << text_of(met) << told.text();
  }
  EXPECT_GT(followed, 2000);
  EXPECT_LT(given_up, 2500);  // slides that no set can follow
}

/// Two rows that weave over the border between them; a vehicle on that border, in column 2.
Plan weave(double below_rad, double above_rad, double turn_radius_m) {
  Plan plan = empty_plan(6, 2, 1.0, turn_radius_m);
  for (int ix = 0; ix < 6; ++ix) {
    plan.heading_rad[plan.grid.index({ix, 0})] = Heading::stored(below_rad);
    plan.heading_rad[plan.grid.index({ix, 1})] = Heading::stored(-above_rad);
  }
  return plan;
}

TEST(CornerFlight, ReportsTheCornerWhereAHopOrALeapOverWavesLands) {
  Random random(4);
  for (const double off : {0x1p-36, 0x1p-40}) {
    for (int i = 0; i < 40; ++i) {
      const double r = random.uniform(1.05, 4.0);
      for (const int upper : {0, 1}) {
        // A hop from the lower row's section to itself; a cell of the next column is blocked.
        const double flat = random.uniform(0.002, 0.02);
        Plan plan = weave(flat, 1.5 * flat, r);
        plan.region[plan.grid.index({3, upper})] = Region::obstacle;
        const PlanFlow plan_flow(plan);
        const double move = 4.0 * r * std::sin(static_cast<double>(plan.heading_rad[2]));
        Told hop;
        follow_to_section(
            plan_flow.flow(),
            front_of_section(plan_flow.flow(), section_of(2, Side::top), 1.0 - off - move),
            most_crossings, hop);
        bool hopped = false;
        for (const Told::Arrival& a : hop.arrivals) hopped = hopped || a.hop;
        ASSERT_TRUE(hopped && !hop.gave_up) << hop.text();
        ASSERT_TRUE(tells_end(hop, CellKind::obstacle, static_cast<long double>(move))) << upper;
      }
      // Flatter than both commands: many waves, the last of which lands next to the corner.
      const int waves = 4 + static_cast<int>(random.below(5));
      Plan plan = weave(1.0, 1.2, r);
      plan.region[plan.grid.index({3, 1})] = Region::obstacle;
      const PlanFlow plan_flow(plan);
      const double length = (4.0 * waves + 2.0) * r;
      const double flat = 0.9 / length;
      Front front;
      front.ix = 2;
      front.iy = 1;
      front.entry.heading = unit_enclosure(flat);
      front.entry.position_m = {1.0 - off - length * std::sin(flat), 0.0};
      Told told;
      follow_to_section(plan_flow.flow(), front, most_crossings, told);
      ASSERT_FALSE(told.gave_up);
      ASSERT_TRUE(tells_end(told, CellKind::obstacle, static_cast<long double>(length * flat)))
          << off << " " << waves << told.text();
    }
  }
}

TEST(CornerFlight, FindsThePlaceWhereAHeadingAlmostAlongABorderCrossesIt) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    Plan plan = empty_plan(3, 3, 1.0, random.uniform(1.05, 3.0));
    for (float& command : plan.heading_rad) command = Heading::stored(random.uniform(-pi, pi));
    plan.heading_rad[4] = NAN;
    const PlanFlow plan_flow(plan);
    const Flow flow = plan_flow.flow();
    const auto border = static_cast<Side>(random.below(4));
    const auto towards =
        static_cast<Side>((static_cast<int>(border) + (random.below(2) == 0 ? 1 : 3)) & 3);
    const bool upwards = cell_enclosure::is_far(towards);
    const double creep = 0x1p-40;
    const double from = upwards ? 0.125 : 0.875;
    const double length = random.uniform(0.01, 0.87);
    const double line = cell_enclosure::line_of(border, 1.0);
    const double inside = line == 0.0 ? creep * length : 1.0 - creep * length;
    Front front;
    front.ix = front.iy = 1;
    front.entry.position_m = cell_enclosure::from_parts(inside, from, border);
    front.entry.heading = cell_enclosure::from_parts(
        {-2.0 * creep, 2.0 * creep},
        upwards ? Interval(1.0 - 0x1p-50, 1.0) : Interval(-1.0, -1.0 + 0x1p-50), border);
    Told told;
    follow_to_section(flow, front, most_crossings, told);
    if (told.gave_up) continue;
    const WideCommands<Wide> commands(flow);
    const Wide out = cell_enclosure::is_far(border) ? Wide(creep) : Wide(-creep);
    const Wide on = (upwards ? 1 : -1) * sqrt(Wide(1) - Wide(creep) * Wide(creep));
    const Wide place = Wide(from) + Wide(upwards ? length : -length);
    const Wide start(1.0 - line);
    const bool vertical = cell_enclosure::is_vertical(border);
    const Cell other = beyond({1, 1}, border);
    WideFlight<Wide> flight(commands, other.ix, other.iy,
                            vertical ? Vec{start, place} : Vec{place, start},
                            vertical ? Vec{out, on} : Vec{on, out});
    const auto met = flight.fly(300);
    if (met.section == WideMeeting<Wide>::none && met.end == Verdict::undecided) continue;
    ASSERT_TRUE(told.has(met)) << "border " << static_cast<int>(border) << " towards "
                               << static_cast<int>(towards) << " after " << length << ": met "
                               << text_of(met) << told.text();
  }
}

TEST(CornerFlight, IsNotLostInCellsThatTurnBackOverTheBorderItRunsAlong) {
  // Up along the border between two columns; the right one turns left. States followed into it come
  // out of it at once, again and again.
  Plan plan = empty_plan(4, 4, 1.0, 2.0);
  for (int iy = 0; iy < 4; ++iy) {
    plan.heading_rad[plan.grid.index({1, iy})] = NAN;
    plan.heading_rad[plan.grid.index({2, iy})] = 2.5F;
  }
  const PlanFlow plan_flow(plan);
  for (const double off : {0.0, 0x1p-36, 0x1p-40}) {
    Front front;
    front.ix = 1;
    front.iy = 0;
    front.entry.position_m = {1.0 - off, 0.5};
    front.entry.heading = {0.0, 1.0};
    Told told;
    follow_to_section(plan_flow.flow(), front, most_crossings, told);
    EXPECT_FALSE(told.gave_up || told.nothing()) << off << told.text();
  }
}

}  // namespace
}  // namespace fairway
