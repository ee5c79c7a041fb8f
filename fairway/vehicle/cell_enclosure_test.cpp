#include "fairway/vehicle/cell_enclosure.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <sstream>
#include <string>

#include "fairway/base/random.hpp"
#include "fairway/vehicle/testing/wide_motion.hpp"

namespace fairway {
namespace {

using Vec = WideVec<Wide>;
constexpr double pi = std::numbers::pi;

/// Except for the oracle's own rounding.
bool holds(const Interval& x, const Wide& exact) {
  const Wide own(1e-30);
  return Wide(x.lo) - own <= exact && exact <= Wide(x.hi) + own;
}
bool holds(const IntervalVec2& v, const Vec& exact) {
  return holds(v.x, exact.x) && holds(v.y, exact.y);
}

/// All headings between two angles.
IntervalVec2 headings_between(double low_rad, double high_rad) {
  const IntervalVec2 a = unit_enclosure(low_rad);
  const IntervalVec2 b = unit_enclosure(high_rad);
  IntervalVec2 all{hull(a.x, b.x), hull(a.y, b.y)};
  for (int k = -8; k <= 8; ++k) {
    if (low_rad > k * pi / 2 || high_rad < k * pi / 2) continue;
    const double cosine = k % 2 == 0 ? (k % 4 == 0 ? 1.0 : -1.0) : 0.0;
    const double sine = k % 2 == 0 ? 0.0 : (k % 4 == 1 || k % 4 == -3 ? 1.0 : -1.0);
    all.x = hull(all.x, cosine);
    all.y = hull(all.y, sine);
  }
  return all;
}

/// A set of states as they may enter a cell, with a way to draw one of them.
struct Draw {
  CellShape size;
  double command_rad = 0.0;
  bool has_command = true;
  bool already_there = false;
  int turn = 0;  // when known, the states are given by their centres
  Interval x, y;
  double low_rad = 0.0, high_rad = 0.0;

  CellEntry entry() const {
    CellEntry entry;
    entry.heading = headings_between(low_rad, high_rad);
    entry.position_m = {x, y};
    if (turn == 0) return entry;
    entry.turn = turn;
    entry.centre_m = {x, y};
    entry.position_m = {{0.0, size.cell_m}, {0.0, size.cell_m}};
    return entry;
  }
  CellOrder order() const {
    CellOrder order;
    order.has_command = has_command;
    order.already_there = already_there;
    if (has_command) order.heading = unit_enclosure(command_rad);
    return order;
  }
};

std::ostream& operator<<(std::ostream& out, const Draw& d) {
  out.precision(17);
  return out << "d=" << d.size.cell_m << " r=" << d.size.turn_radius_m << " x=[" << d.x.lo << ", "
             << d.x.hi << "] y=[" << d.y.lo << ", " << d.y.hi << "] h=[" << d.low_rad << ", "
             << d.high_rad << "] psi=" << (d.has_command ? d.command_rad : std::nan(""))
             << " turn=" << d.turn << (d.already_there ? " there" : "");
}

constexpr std::array<double, 8> tiny{0.0, 1e-8, -1e-8, 1e-15, -1e-15, 1e-4, -1e-4, 1e-12};

double place(Random& random, double d) {
  switch (random.below(6)) {
    case 0:
      return 0.0;
    case 1:
      return d;
    case 2:
      return random.below(2) == 0 ? 1e-8 * d : d - 1e-8 * d;
    default:
      return random.unit() * d;
  }
}
double heading(Random& random) {
  const double axis = (static_cast<double>(random.below(4)) - 1.0) * (pi / 2);
  switch (random.below(5)) {
    case 0:
      return axis;
    case 1:
      return static_cast<double>(static_cast<float>(axis));
    case 2:
      return axis + tiny[random.below(tiny.size())];
    default:
      return random.uniform(-pi, pi);
  }
}
Interval around(Random& random, double x, double width) {
  const double low = random.unit() * width;
  return {x - low, x + width - low};
}

Draw draw(Random& random) {
  static constexpr std::array<double, 6> radii{1.0000001, 1.001, 1.4, 2.5, 10.0, 1000.0};
  static constexpr std::array<double, 6> widths{0.0, 1e-12, 1e-7, 1e-3, 0.05, 0.3};
  Draw d;
  d.size = {1.0, radii[random.below(radii.size())]};
  const double h = heading(random);
  const double position_width = widths[random.below(widths.size())];
  const double heading_width = widths[random.below(widths.size())];
  const Interval span = around(random, h, heading_width);
  d.low_rad = span.lo;
  d.high_rad = span.hi;
  const auto command = [&] {
    switch (random.below(6)) {
      case 0:
        return h + tiny[random.below(tiny.size())];
      case 1:
        return (h > 0.0 ? h - pi : h + pi) + tiny[random.below(tiny.size())];
      case 2:  // mirrored in a border
        return random.below(2) == 0 ? -h : (h > 0.0 ? pi - h : -pi - h);
      default:
        return heading(random);
    }
  };
  d.command_rad = static_cast<double>(static_cast<float>(command()));
  d.has_command = random.below(8) != 0;
  double x = place(random, 1.0);
  double y = place(random, 1.0);
  if (random.below(3) == 0) {
    // Through a corner: backwards from it along an arc of the turning radius.
    const double k = random.below(2) == 0 ? 1.0 : -1.0;
    const double turned = random.uniform(0.0, 0.9);
    const double r = d.size.turn_radius_m;
    const double corner_x = random.below(2) == 0 ? 0.0 : 1.0;
    const double corner_y = random.below(2) == 0 ? 0.0 : 1.0;
    const double w = h + k * turned;
    const double from_x = corner_x - k * r * (std::sin(w) - std::sin(h));
    const double from_y = corner_y + k * r * (std::cos(w) - std::cos(h));
    if (from_x >= 0.0 && from_x <= 1.0 && from_y >= 0.0 && from_y <= 1.0) {
      x = from_x;
      y = from_y;
    }
  }
  if (random.below(3) == 0) {
    d.turn = random.below(2) == 0 ? 1 : -1;
    const double kr = d.turn * d.size.turn_radius_m;
    d.x = around(random, x - kr * std::sin(h), position_width);
    d.y = around(random, y + kr * std::cos(h), position_width);
  } else {
    d.x = intersection(around(random, x, position_width), {0.0, 1.0});
    d.y = intersection(around(random, y, position_width), {0.0, 1.0});
  }
  if (d.has_command && d.turn == 0 && heading_width == 0.0 && random.below(4) == 0) {
    d.already_there = true;
    d.low_rad = d.high_rad = d.command_rad;
  }
  return d;
}

double member(Random& random, Interval x) {
  switch (random.below(4)) {
    case 0:
      return x.lo;
    case 1:
      return x.hi;
    default:
      return std::min(x.hi, x.lo + random.unit() * x.width());
  }
}

bool tells(const CellDeparture& told, const WideExit<Wide>& exit, bool has_command) {
  const bool vertical = cell_enclosure::is_vertical(exit.side);
  if (told.side != exit.side || !holds(told.along_m, vertical ? exit.p.y : exit.p.x) ||
      !holds(told.heading, exit.u)) {
    return false;
  }
  if (exit.turn != 0 && (told.turn != exit.turn || !holds(told.centre_m, exit.centre)))
    return false;
  if (exit.turn == 0 && told.turn != 0) return false;
  if (told.aligned != (exit.aligned && has_command)) return false;
  return exit.length <= static_cast<long double>(told.length_m) * (1 + 1e-16L) + 1e-24L;
}

/// An exit through a corner may be reported as one through the other side that ends there.
bool tells_corner(const CellDeparture& told, const WideExit<Wide>& exit, double d) {
  const Wide near(1e-24);
  const auto at = [&](const Wide& q, double end) { return abs(Wide(q - end)) < near; };
  const bool vertical = cell_enclosure::is_vertical(told.side);
  const double line = cell_enclosure::line_of(told.side, d);
  const Wide& across = vertical ? exit.p.x : exit.p.y;
  const Wide& along = vertical ? exit.p.y : exit.p.x;
  return at(across, line) && holds(told.heading, exit.u) &&
         ((told.low_corner && at(along, 0.0)) || (told.high_corner && at(along, d)));
}

std::string text_of(const CellDepartures& told) {
  std::ostringstream out;
  out.precision(17);
  for (const CellDeparture& d : told) {
    out << "\n  reported: side " << static_cast<int>(d.side) << " along [" << d.along_m.lo << ", "
        << d.along_m.hi << "] heading [" << d.heading.x.lo << ", " << d.heading.x.hi << "] ["
        << d.heading.y.lo << ", " << d.heading.y.hi << "] turn " << d.turn << " aligned "
        << d.aligned << " length " << d.length_m << (d.low_corner ? " low" : "")
        << (d.high_corner ? " high" : "") << (d.grazes ? " grazes" : "");
  }
  return out.str();
}

struct Count {
  int states = 0;
  int sets = 0;
  int too_wide = 0;
};

/// Every drawn state leaves as reported.
void expect_told(Random& random, const Draw& d, Count& count) {
  const CellDepartures told = enclose_departures(d.entry(), d.order(), d.size);
  ++count.sets;
  count.too_wide += told.too_wide;
  if (told.too_wide) return;
  const WideCell<Wide> cell(d.size.cell_m, d.size.turn_radius_m);
  for (int i = 0; i < 6; ++i) {
    const double h = member(random, {d.low_rad, d.high_rad});
    const Vec u = wide_unit<Wide>(h);
    Vec p{Wide(member(random, d.x)), Wide(member(random, d.y))};
    if (d.turn != 0) {
      p = p - Wide(d.turn * d.size.turn_radius_m) * wide_left(u);
      const Wide size(d.size.cell_m);
      if (p.x < 0 || p.x > size || p.y < 0 || p.y > size) continue;
    }
    ++count.states;
    WideExits<Wide> exits;
    std::array<int, 2> turns{0, 0};
    const Vec c = wide_unit<Wide>(d.command_rad);
    if (d.has_command && !d.already_there) {
      const int turn = WideCell<Wide>::turn_of(u, c);
      turns = turn == 2 ? std::array<int, 2>{1, -1} : std::array<int, 2>{turn, turn};
    }
    for (const int turn : turns) {
      if (turn == 0) {
        WideExit<Wide> straight;
        straight.aligned = d.has_command;
        exits = {};
        cell.straight(p, u, straight, exits);
      } else {
        exits = cell.turning(p, u, c, turn);
      }
      ASSERT_GT(exits.count, 0U);
      for (std::size_t e = 0; e < exits.count; ++e) {
        const WideExit<Wide>& exit = exits.of[e];
        bool is_told = false;
        for (const CellDeparture& departure : told) {
          is_told = is_told || tells(departure, exit, d.has_command) ||
                    (exits.count > 1 && tells_corner(departure, exit, d.size.cell_m));
        }
        ASSERT_TRUE(is_told) << "h=" << h << " p=(" << p.x << ", " << p.y << ") leaves by side "
                             << static_cast<int>(exit.side) << " at (" << exit.p.x << ", "
                             << exit.p.y << ") aligned " << exit.aligned << " turn " << exit.turn
                             << " length " << exit.length << ", " << exits.count << " exits"
                             << text_of(told);
      }
    }
  }
}

TEST(CellEnclosure, HoldsEveryExactMotionOfStatesDrawnFromTheEntry) {
  Random random(1);
  Count count;
  for (int i = 0; i < 12000; ++i) {
    const Draw d = draw(random);
    SCOPED_TRACE(::testing::PrintToString(d));
    expect_told(random, d, count);
    if (::testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(count.states, 40000);
  EXPECT_LT(count.too_wide, count.sets / 5);
}

TEST(CellEnclosure, ReportsForOneStateOnlyWhatItDoes) {
  Random random(2);
  int several = 0;
  constexpr int draws = 2000;
  for (int i = 0; i < draws; ++i) {
    Draw d;
    d.size = {1.0, random.uniform(1.01, 20.0)};
    d.x = random.uniform(0.01, 0.99);
    d.y = random.uniform(0.01, 0.99);
    d.low_rad = d.high_rad = random.uniform(-pi, pi);
    d.command_rad = random.uniform(-pi, pi);
    const CellDepartures told = enclose_departures(d.entry(), d.order(), d.size);
    ASSERT_FALSE(told.too_wide);
    several += told.end() - told.begin() != 1;
    for (const CellDeparture& departure : told) {
      ASSERT_LT(departure.along_m.width(), 1e-6) << d;
      ASSERT_LT(departure.length_m, 2.3 * d.size.turn_radius_m) << d;
    }
  }
  EXPECT_LT(several, draws / 200);
}

TEST(CellEnclosure, BoundsTheAngleBetweenAnyTwoHeadings) {
  Random random(3);
  for (int i = 0; i < 4000; ++i) {
    const double a = random.uniform(-pi, pi);
    const double turned =
        random.below(4) == 0 ? std::exp(-30.0 * random.unit()) : random.uniform(0.0, pi);
    const double bound = cell_enclosure::angle_bound(unit_enclosure(a), unit_enclosure(a - turned));
    ASSERT_GE(bound, turned * (1 - 1e-15)) << a << " " << turned;
    if (turned < 1.5) {
      ASSERT_LE(bound, turned * 1.03 + 1e-7) << a << " " << turned;
    }
  }
  // Sets so wide that they contain opposite headings: still a bound, and a number.
  const IntervalVec2 any{{-1.0, 1.0}, {-1.0, 1.0}};
  EXPECT_GE(cell_enclosure::angle_bound(any, any), pi);
  EXPECT_GE(cell_enclosure::angle_bound(unit_enclosure(0.0), unit_enclosure(pi)), pi);
}

TEST(CellEnclosure, FollowsBothTurnsFromTheOppositeHeading) {
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    Draw d;
    d.size = {1.0, random.uniform(1.01, 5.0)};
    d.x = random.uniform(0.3, 0.7);
    d.y = random.uniform(0.3, 0.7);
    d.command_rad = 0.0;
    d.low_rad = d.high_rad = pi;
    int turned = 0;
    for (const CellDeparture& departure : enclose_departures(d.entry(), d.order(), d.size)) {
      turned |= departure.turn > 0 ? 1 : departure.turn < 0 ? 2 : 0;
    }
    ASSERT_EQ(turned, 3) << d;
  }
}

TEST(CellEnclosure, ReportsTheTouchOfASide) {
  for (const double radius : {1.25, 2.0, 8.0}) {
    // Rises, turning right, to heading 0 exactly at the top, and on down.
    Draw d;
    d.size = {1.0, radius};
    d.turn = -1;
    d.x = 0.5;
    d.y = 1.0 - radius;
    d.low_rad = d.high_rad = 0.25 / radius;
    d.command_rad = -1.5;
    bool touched = false;
    bool went_on = false;
    for (const CellDeparture& departure : enclose_departures(d.entry(), d.order(), d.size)) {
      touched = touched || (departure.side == Side::top && departure.heading.y.contains(0.0));
      went_on = went_on || departure.side == Side::right;
    }
    EXPECT_TRUE(touched) << d;
    EXPECT_TRUE(went_on) << d;
  }
}

}  // namespace
}  // namespace fairway
