#include "fairway/verify/section_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/verify/certify.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/testing/told_flights.hpp"
#include "fairway/verify/undecided_sections.hpp"

namespace fairway {
namespace {

constexpr int most_crossings = 3000;

/// The sections of a flow that have leaves.
std::vector<std::size_t> live_sections(const Flow& flow) {
  const SectionVerdicts sections = undecided_sections(flow, 0);
  std::vector<std::size_t> live;
  for (std::size_t s = 0; s + 1 < sections.first.size(); ++s) {
    if (sections.first[s] < sections.first[s + 1]) live.push_back(s);
  }
  return live;
}

/// The exact flight of the state of a section at `along_m`.
WideMeeting<Wide> fly_from(const WideCommands<Wide>& commands, std::size_t section,
                           const Wide& along_m, std::uint64_t crossings, Random& random) {
  const Flow& flow = commands.flow;
  const Front start = front_of_section(flow, section, 0.0);
  const auto side = static_cast<Side>(section % 4);
  const Wide line(cell_enclosure::is_far(side) ? 0.0 : flow.grid.cell_m);
  const bool vertical = cell_enclosure::is_vertical(side);
  const WideVec<Wide> p{vertical ? line : along_m, vertical ? along_m : line};
  WideFlight<Wide> flight(commands, start.ix, start.iy, p, commands.unit[section / 4],
                          [&](std::size_t n) { return random.below(n); });
  return flight.fly(crossings);
}

Interval part_of_side(Random& random, double cell_m) {
  static constexpr std::array<double, 7> widths{0.0, 0x1p-32, 1e-8, 1e-4, 0.02, 0.25, 1.0};
  const double width = widths[random.below(widths.size())];
  double low = random.unit() * (1.0 - width);
  if (random.below(4) == 0) low = 0.0;
  if (random.below(4) == 0) low = 1.0 - width;
  return {low * cell_m, std::min(low + width, 1.0) * cell_m};
}

double member(Random& random, Interval x) {
  if (random.below(4) == 0) return x.lo;
  if (random.below(3) == 0) return x.hi;
  return std::min(x.hi, x.lo + random.unit() * x.width());
}

TEST(SectionFlight, MeetsOneOfTheThingsReportedFromEveryPlaceOfTheStart) {
  Random random(1);
  int flown = 0;
  int given_up = 0;
  int sets = 0;
  for (std::uint64_t number = 0; number < 150; ++number) {
    const Plan plan = random_plan(number);
    const PlanFlow plan_flow(plan);
    const Flow flow = plan_flow.flow();
    const WideCommands<Wide> commands(flow);
    const std::vector<std::size_t> live = live_sections(flow);
    for (int i = 0; i < 24 && !live.empty(); ++i) {
      const std::size_t section = live[random.below(live.size())];
      const Interval along_m = part_of_side(random, flow.grid.cell_m);
      Told told;
      follow_to_section(flow, front_of_section(flow, section, along_m), most_crossings, told);
      ASSERT_FALSE(told.nothing()) << "plan " << number << " section " << section;
      ++sets;
      given_up += told.gave_up;
      if (told.gave_up) continue;
      for (int k = 0; k < 3; ++k) {
        const double place = member(random, along_m);
        const auto met = fly_from(commands, section, Wide(place), 300, random);
        if (met.section == WideMeeting<Wide>::none && met.end == Verdict::undecided) continue;
        ++flown;
        ASSERT_TRUE(told.has(met))
            << "plan " << number << " section " << section << " from [" << along_m.lo << ", "
            << along_m.hi << "] at " << place << ": met " << text_of(met) << told.text();
      }
    }
  }
  EXPECT_GT(flown, 7000);
  EXPECT_LT(given_up, sets / 10);
}

/// Two rows whose commands weave over the border between them.
Plan weave(double below_rad, double above_rad, double ratio) {
  Plan plan = empty_plan(6, 2, 1.0, 1.0 / ratio);
  for (int ix = 0; ix < 6; ++ix) {
    plan.heading_rad[plan.grid.index({ix, 0})] = Heading::stored(below_rad);
    plan.heading_rad[plan.grid.index({ix, 1})] = Heading::stored(-above_rad);
  }
  return plan;
}

TEST(SectionFlight, HopsMoveEveryPlaceByTheSameDistance) {
  Random random(2);
  int hops = 0;
  for (const double angle : {0.3, 0.1, 0.01, 1e-3, 1e-4, 1e-5}) {
    for (const double steeper : {1.0, 1.3, 3.0}) {
      for (const double ratio : {0.5, 0.1, 0.99}) {
        for (const bool back : {false, true}) {
          const double turned = angle * steeper;
          const Plan plan =
              back ? weave(pi - angle, pi - turned, ratio) : weave(angle, turned, ratio);
          const PlanFlow plan_flow(plan);
          const Flow flow = plan_flow.flow();
          const WideCommands<Wide> commands(flow);
          const std::size_t section = section_of(2, Side::top);
          // For the command as stored.
          const double move = 4.0 / ratio * std::sin(static_cast<double>(plan.heading_rad[2]));
          const Interval along_m = part_of_side(random, 1.0);
          Told told;
          follow_to_section(flow, front_of_section(flow, section, along_m), most_crossings, told);
          for (const Told::Arrival& a : told.arrivals) {
            if (!a.hop) continue;
            ++hops;
            ASSERT_EQ(a.section, section);
            // From a leaf, as in the prover: never more than the true move.
            const UnitRange leaf = units_of(along_m, 1.0);
            const double least = least_move({0, units_of(a.along_m, 1.0), 0.0F, true}, leaf);
            ASSERT_LE(least, move * 0x1p32 * (1.0 + 1e-6) + 4.0) << angle << " " << ratio;
          }
          for (int k = 0; k < 4; ++k) {
            const double place = member(random, along_m);
            const auto met = fly_from(commands, section, Wide(place), 40, random);
            if (met.section != section) continue;
            const double moved = static_cast<double>(met.along_m - Wide(place));
            ASSERT_NEAR(moved, back ? -move : move, 1e-6 * move);
            ASSERT_TRUE(told.has(met)) << text_of(met) << told.text();
          }
        }
      }
    }
  }
  EXPECT_GT(hops, 60);
}

/// Lemma 5: how far a wave goes does not depend on where it starts.
TEST(SectionFlight, WavesMoveEveryPlaceByFourRadiiTimesTheSineOfTheirAngle) {
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    const double r = random.uniform(1.05, 20.0);
    const double angle = std::exp(random.uniform(-12.0, -4.0)) / r;
    const WideCell<Wide> cell(1.0, r);
    const WideVec<Wide> up = wide_unit<Wide>(random.uniform(0.5, 1.4));     // of the cell below
    const WideVec<Wide> down = wide_unit<Wide>(-random.uniform(0.5, 1.4));  // of the cell above
    WideVec<Wide> p{Wide(random.uniform(0.01, 0.6)), Wide(0)};
    WideVec<Wide> u = wide_unit<Wide>(angle);
    const Wide move = Wide(4.0 * r) * u.y;
    for (int wave = 0; wave < 3; ++wave) {
      const Wide begin = p.x;
      const auto above = cell.turning(p, u, down, -1).first();
      ASSERT_EQ(above.side, Side::bottom);
      const WideVec<Wide> over{above.p.x, Wide(1)};
      const auto below = cell.turning(over, above.u, up, +1).first();
      ASSERT_EQ(below.side, Side::top);
      p = {below.p.x, Wide(0)};
      u = below.u;
      ASSERT_LT(abs(p.x - begin - move), Wide(1e-50)) << r << " " << angle;
    }
  }
}

TEST(SectionFlight, LeapsOverWavesToWhereFlyingThemOneByOneComes) {
  Random random(3);
  int leapt = 0;
  for (const double angle : {0.02, 5e-3, 1e-3, 3e-4}) {
    for (const bool back : {false, true}) {
      // The vehicle comes from the left (right) with a flatter heading than both commands.
      Plan plan = weave(back ? pi - 1.0 : 1.0, back ? pi - 1.2 : 1.2, 0.5);
      const std::size_t from = back ? 5 : 0;
      plan.heading_rad[from] = Heading::stored(back ? pi - angle : angle);
      const PlanFlow plan_flow(plan);
      const Flow flow = plan_flow.flow();
      const WideCommands<Wide> commands(flow);
      const std::size_t section = section_of(from, back ? Side::left : Side::right);
      for (int i = 0; i < 12; ++i) {
        const double low = 1.0 - 4e-6 * random.unit();
        const Interval along_m{low, std::min(1.0, low + 1e-9 * random.unit())};
        Told told;
        follow_to_section(flow, front_of_section(flow, section, along_m), most_crossings, told);
        ASSERT_FALSE(told.nothing());
        if (told.gave_up) continue;
        const auto met = fly_from(commands, section, Wide(member(random, along_m)), 20000, random);
        leapt += met.crossings > 100;
        ASSERT_TRUE(told.has(met)) << angle << ": met " << text_of(met) << told.text();
      }
    }
  }
  EXPECT_GT(leapt, 20);
}

TEST(SectionFlight, RecognisesACircleAndOnlyThat) {
  // A command always behind the vehicle keeps it on one circle: cells on a ring of radius 2.5.
  Plan plan = empty_plan(8, 8, 1.0, 2.5);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Vec2 p = plan.grid.center(plan.grid.cell_at(i)) - Vec2{4.0, 4.0};
    plan.heading_rad[i] = Heading::stored(std::atan2(p.y, p.x) + pi / 2 + 1.2);
  }
  const PlanFlow plan_flow(plan);
  const Flow flow = plan_flow.flow();
  Front front;
  front.ix = 6;
  front.iy = 4;
  front.entry.position_m = {0.5, 0.01};
  front.entry.heading = unit_enclosure(pi / 2);
  Told told;
  follow_to_section(flow, front, most_crossings, told);
  ASSERT_FALSE(told.gave_up);
  ASSERT_EQ(told.ends.size(), 1U) << told.text();
  EXPECT_EQ(told.ends[0].verdict, Verdict::trapped);
  EXPECT_TRUE(told.arrivals.empty());
  // A target on the ring ends it.
  std::vector<CellKind> kind = plan_flow.kind;
  kind[flow.grid.index({1, 4})] = CellKind::target;
  Flow with_target = flow;
  with_target.kind = kind.data();
  Told other;
  follow_to_section(with_target, front, most_crossings, other);
  ASSERT_EQ(other.ends.size(), 1U) << other.text();
  EXPECT_EQ(other.ends[0].verdict, Verdict::reach);
}

Told told_straight(const Flow& flow, IntervalVec2 position_m, IntervalVec2 heading) {
  Front front;
  front.ix = 1;
  front.iy = 1;
  front.entry.position_m = position_m;
  front.entry.heading = heading;
  Told told;
  follow_to_section(flow, front, most_crossings, told);
  return told;
}

bool tells(const Told& told, Verdict verdict) {
  return std::any_of(told.ends.begin(), told.ends.end(),
                     [&](const Told::End& end) { return end.verdict == verdict; });
}

Plan silent_plan() {
  Plan plan = empty_plan(3, 3, 1.0, 2.0);
  plan.heading_rad.assign(plan.grid.size(), std::numeric_limits<float>::quiet_NaN());
  return plan;
}

TEST(SectionFlight, ReportsEveryCellAroundACornerItPassesThrough) {
  const double diagonal = std::sqrt(0.5);
  const Interval plus{below(diagonal), above(diagonal)};
  for (const int dx : {-1, 1}) {
    for (const int dy : {-1, 1}) {
      // From the middle cell through its corner: to the neighbours on both sides, and across.
      for (const Cell blocked : {Cell{1 + dx, 1}, Cell{1, 1 + dy}, Cell{1 + dx, 1 + dy}}) {
        Plan plan = silent_plan();
        plan.region[plan.grid.index(blocked)] = Region::obstacle;
        const PlanFlow plan_flow(plan);
        const Told told = told_straight(plan_flow.flow(), {0.5, 0.5},
                                        {dx > 0 ? plus : -plus, dy > 0 ? plus : -plus});
        EXPECT_TRUE(tells(told, Verdict::collide)) << dx << dy << told.text();
      }
      // The cell across is entered.
      Plan plan = silent_plan();
      plan.region[plan.grid.index({1 + dx, 1 + dy})] = Region::goal;
      const PlanFlow plan_flow(plan);
      const Told told = told_straight(plan_flow.flow(), {0.5, 0.5},
                                      {dx > 0 ? plus : -plus, dy > 0 ? plus : -plus});
      EXPECT_TRUE(tells(told, Verdict::reach)) << dx << dy << told.text();
      // Well away from the corner, the cell next to it is not touched.
      Plan walled = silent_plan();
      walled.region[walled.grid.index({1 + dx, 1})] = Region::obstacle;
      const PlanFlow walled_flow(walled);
      const Told edge =
          told_straight(walled_flow.flow(), {{0.5 - 0.01 * dx, 0.5 - 0.01 * dx}, 0.5},
                        {dx > 0 ? Interval(0.6) : Interval(-0.6), dy > 0 ? 0.8 : -0.8});
      EXPECT_FALSE(tells(edge, Verdict::collide)) << edge.text();
    }
  }
}

TEST(SectionFlight, TouchesWhatLiesBeyondABorderItRunsAlong) {
  // Exactly along the upper border of the middle row, towards a cell above or below it ahead.
  for (const double heading : {1.0, -1.0}) {
    for (const double y : {0.0, 1.0}) {
      for (const Region region : {Region::obstacle, Region::goal}) {
        Plan plan = silent_plan();
        plan.region[plan.grid.index({heading > 0.0 ? 2 : 0, y == 0.0 ? 0 : 2})] = region;
        const PlanFlow plan_flow(plan);
        const Told told = told_straight(plan_flow.flow(), {0.5, y}, {heading, 0.0});
        EXPECT_TRUE(tells(told, region == Region::goal ? Verdict::reach : Verdict::collide))
            << heading << " at " << y << told.text();
        EXPECT_TRUE(tells(told, Verdict::leave)) << told.text();
        // The cell directly above its start is touched, too.
        Plan above_it = silent_plan();
        above_it.region[above_it.grid.index({1, y == 0.0 ? 0 : 2})] = region;
        const PlanFlow above_flow(above_it);
        EXPECT_TRUE(tells(told_straight(above_flow.flow(), {0.5, y}, {heading, 0.0}),
                          region == Region::goal ? Verdict::reach : Verdict::collide));
        // Slightly away from the border, nothing is.
        EXPECT_FALSE(tells(told_straight(above_flow.flow(), {0.5, 0.5}, {heading, 0.0}),
                           region == Region::goal ? Verdict::reach : Verdict::collide));
      }
    }
  }
}

TEST(SectionFlight, GivesUpRatherThanReportHalf) {
  const Plan plan = random_plan(0);
  const PlanFlow plan_flow(plan);
  const Flow flow = plan_flow.flow();
  for (const std::size_t section : live_sections(flow)) {
    Told told;
    follow_to_section(flow, front_of_section(flow, section, {0.0, flow.grid.cell_m}), 0, told);
    ASSERT_TRUE(told.gave_up);
  }
}

}  // namespace
}  // namespace fairway
