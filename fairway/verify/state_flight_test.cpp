#include "fairway/verify/state_flight.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fairway/base/random.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/testing/told_flights.hpp"

namespace fairway {
namespace {

constexpr int most_crossings = 3000;

struct Start {
  double x_m;
  double y_m;
  double heading_rad;
};

/// A coordinate after `low`: borders, corners and their neighbours on purpose.
double coordinate(Random& random, double low, int n, double d) {
  const double border =
      low + static_cast<double>(random.below(static_cast<std::uint64_t>(n) + 1)) * d;
  switch (random.below(6)) {
    case 0:
      return border;
    case 1:
      return std::nextafter(border, random.below(2) == 0 ? 1e9 : -1e9);
    case 2:
      return border + 1e-8 * d * random.uniform(-1.0, 1.0);
    default:
      return low + random.unit() * n * d;
  }
}

double heading(Random& random, const Flow& flow) {
  static constexpr std::array<double, 6> off{0.0, 0.0, 1e-8, -1e-8, 1e-15, -1e-13};
  const auto command = static_cast<double>(flow.heading_rad[random.below(flow.grid.size())]);
  const double axis = (static_cast<double>(random.below(4)) - 1.0) * (pi / 2);
  double h = random.uniform(-pi, pi);
  switch (random.below(6)) {
    case 0:
      h = axis;
      break;
    case 1:
      h = static_cast<double>(static_cast<float>(axis));
      break;
    case 2:
      h = std::isnan(command) ? axis : command;
      break;
    case 3:
      h = std::isnan(command) ? axis : command + pi;
      break;
    default:
      return h;
  }
  return Heading::from_rad(h + off[random.below(off.size())]).rad();
}

/// Calls with the cell and the exact place in it, for every closed cell that contains the start and
/// that its heading does not leave at once.
template <typename Body>
void for_own_cells(const Flow& flow, const Start& s, const WideVec<Wide>& u, const Body& body) {
  const Wide d(flow.grid.cell_m);
  const int cx = static_cast<int>(std::floor((s.x_m - flow.grid.x0_m) / flow.grid.cell_m));
  const int cy = static_cast<int>(std::floor((s.y_m - flow.grid.y0_m) / flow.grid.cell_m));
  for (int iy = cy - 1; iy <= cy + 1; ++iy) {
    for (int ix = cx - 1; ix <= cx + 1; ++ix) {
      const WideVec<Wide> p{Wide(s.x_m) - (Wide(flow.grid.x0_m) + Wide(ix) * d),
                            Wide(s.y_m) - (Wide(flow.grid.y0_m) + Wide(iy) * d)};
      if (p.x < 0 || p.x > d || p.y < 0 || p.y > d) continue;
      const bool heads_out = (p.x == 0 && u.x < 0) || (p.x == d && u.x > 0) ||
                             (p.y == 0 && u.y < 0) || (p.y == d && u.y > 0);
      body(ix, iy, p, heads_out);
    }
  }
}

/// Heading along the border it is on, and turned out of the cell at once: the state does not belong
/// to that cell (docs/trust.md, lemma 4).
bool turns_out(const WideVec<Wide>& p, const WideVec<Wide>& u, const WideVec<Wide>& command,
               double cell_m) {
  const Wide d(cell_m);
  return (p.x == 0 && u.x == 0 && command.x < 0) || (p.x == d && u.x == 0 && command.x > 0) ||
         (p.y == 0 && u.y == 0 && command.y < 0) || (p.y == d && u.y == 0 && command.y > 0);
}

TEST(StateFlight, MeetsOneOfTheThingsReportedFromEveryCellTheStateBelongsTo) {
  Random random(1);
  int flown = 0;
  for (std::uint64_t number = 0; number < 120; ++number) {
    const Plan plan = random_plan(number);
    const PlanFlow plan_flow(plan);
    const Flow flow = plan_flow.flow();
    const WideCommands<Wide> commands(flow);
    for (int i = 0; i < 120; ++i) {
      const Start s{coordinate(random, flow.grid.x0_m, flow.grid.nx, flow.grid.cell_m),
                    coordinate(random, flow.grid.y0_m, flow.grid.ny, flow.grid.cell_m),
                    heading(random, flow)};
      Told told;
      follow_state_as_set(flow, s.x_m, s.y_m, s.heading_rad, most_crossings, told);
      if (told.gave_up) continue;
      ASSERT_FALSE(told.nothing());
      const WideVec<Wide> u = wide_unit<Wide>(s.heading_rad);
      for_own_cells(flow, s, u, [&](int ix, int iy, const WideVec<Wide>& p, bool heads_out) {
        const CellKind kind = flow.kind_at({ix, iy});
        WideMeeting<Wide> met;
        if (kind == CellKind::obstacle) {
          met.end = Verdict::collide;  // closed
        } else if (heads_out) {
          return;
        } else if (kind == CellKind::target) {
          met.end = Verdict::reach;
        } else if (kind == CellKind::outside) {
          met.end = Verdict::leave;
        } else {
          if (turns_out(p, u, commands.unit[flow.grid.index({ix, iy})], flow.grid.cell_m)) return;
          WideFlight<Wide> flight(commands, ix, iy, p, u,
                                  [&](std::size_t n) { return random.below(n); });
          met = flight.fly(300);
          if (met.section == WideMeeting<Wide>::none && met.end == Verdict::undecided) return;
        }
        ++flown;
        EXPECT_TRUE(told.has(met))
            << "plan " << number << " state " << ::testing::PrintToString(s.x_m) << "," << s.y_m
            << "," << s.heading_rad << " in cell " << ix << "," << iy << ": met " << text_of(met)
            << told.text();
      });
      if (::testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(flown, 10000);
}

bool tells(const Told& told, Verdict verdict) {
  for (const Told::End& end : told.ends) {
    if (end.verdict == verdict) return true;
  }
  return false;
}

Told told_of(const Flow& flow, double x_m, double y_m, double heading_rad) {
  Told told;
  follow_state(flow, x_m, y_m, heading_rad, most_crossings, told);
  return told;
}

TEST(StateFlight, CountsContactWithAClosedObstacleAsACollisionEvenHeadingAway) {
  Plan plan = empty_plan(3, 3, 1.0, 2.0);
  plan.region[4] = Region::obstacle;
  const PlanFlow plan_flow(plan);
  const Flow flow = plan_flow.flow();
  for (const Vec2 p :
       {Vec2{1.0, 1.5}, Vec2{2.0, 1.5}, Vec2{1.5, 1.0}, Vec2{1.5, 2.0}, Vec2{1.0, 1.0},
        Vec2{2.0, 1.0}, Vec2{1.0, 2.0}, Vec2{2.0, 2.0}, Vec2{1.5, 1.5}}) {
    const double away = std::atan2(p.y - 1.5, p.x - 1.5);
    const Told told = told_of(flow, p.x, p.y, away);
    EXPECT_TRUE(tells(told, Verdict::collide)) << p.x << " " << p.y;
  }
  EXPECT_FALSE(tells(told_of(flow, 0.999999, 1.5, pi), Verdict::collide));
}

TEST(StateFlight, DoesNotBelongToACellThatItsHeadingPointsOutOf) {
  // On the border of a target, heading away: it has not reached it. On the grid's edge, heading in:
  // it has not left.
  Plan plan = empty_plan(3, 3, 1.0, 2.0);
  plan.region[4] = Region::goal;
  const PlanFlow plan_flow(plan);
  for (const double tilt : {0.0, 0.6, -0.6}) {
    for (const Vec2 p : {Vec2{1.0, 1.5}, Vec2{2.0, 1.5}, Vec2{1.5, 1.0}, Vec2{1.5, 2.0},
                         Vec2{0.0, 1.5}, Vec2{3.0, 1.5}, Vec2{1.5, 0.0}, Vec2{1.5, 3.0}}) {
      const bool at_edge = p.x == 0.0 || p.x == 3.0 || p.y == 0.0 || p.y == 3.0;
      const double away = std::atan2(p.y - 1.5, p.x - 1.5) + (at_edge ? pi : 0.0) + tilt;
      const Told told = told_of(plan_flow.flow(), p.x, p.y, Heading::from_rad(away).rad());
      for (const Told::End& end : told.ends) {
        EXPECT_GT(end.length_m, 0.0) << p.x << " " << p.y << " " << away << told.text();
      }
      const Told inwards = told_of(plan_flow.flow(), p.x, p.y, Heading::from_rad(away + pi).rad());
      EXPECT_TRUE(tells(inwards, at_edge ? Verdict::leave : Verdict::reach)) << p.x << " " << p.y;
    }
  }
}

TEST(StateFlight, TakesPlacesAndHeadingsComputedInDoublesForWhatTheyStandFor) {
  // Borders at x0 + i d in doubles, for numbers that are not whole: an obstacle beyond is touched.
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    Plan plan = empty_plan(5, 2, random.uniform(0.1, 40.0), 50.0);
    plan.grid.x0_m = random.below(2) == 0 ? 0.0 : random.uniform(-1e5, 1e5);
    plan.region[2] = plan.region[7] = Region::obstacle;
    const PlanFlow plan_flow(plan);
    const Flow flow = plan_flow.flow();
    const double d = plan.grid.cell_m;
    const double y = 0.7 * d;
    ASSERT_TRUE(tells(told_of(flow, flow.grid.x0_m + 2 * d, y, 3.0), Verdict::collide)) << d;
    ASSERT_TRUE(tells(told_of(flow, flow.grid.x0_m + 3 * d, y, 0.1), Verdict::collide)) << d;
    ASSERT_TRUE(tells(told_of(flow, flow.grid.x0_m + flow.grid.nx * d, y, 0.1), Verdict::leave))
        << d;
    Plan upright = empty_plan(2, 5, d, 50.0);
    upright.grid.y0_m = plan.grid.x0_m;
    upright.region[4] = upright.region[5] = Region::obstacle;
    const PlanFlow upright_flow(upright);
    const Flow up = upright_flow.flow();
    ASSERT_TRUE(tells(told_of(up, y, up.grid.y0_m + 2 * d, -1.4), Verdict::collide)) << d;
    ASSERT_TRUE(tells(told_of(up, y, up.grid.y0_m + 3 * d, 1.4), Verdict::collide)) << d;
    ASSERT_TRUE(tells(told_of(up, y, up.grid.y0_m + up.grid.ny * d, 1.4), Verdict::leave)) << d;
  }
  // A heading opposite to the command in doubles: both turns. The left turn leaves by the left
  // half, the right turn by the right half.
  for (int i = 0; i < 500; ++i) {
    Plan plan = empty_plan(4, 4, 1.0, 1.2);
    const float command = Heading::stored(random.uniform(-pi, pi));
    plan.heading_rad.assign(plan.grid.size(), command);
    for (std::size_t c = 0; c < plan.grid.size(); ++c) {
      if (c != 5) plan.region[c] = Region::obstacle;
    }
    const PlanFlow plan_flow(plan);
    const double opposite = Heading::from_rad(static_cast<double>(command) + pi).rad();
    const Told told = told_of(plan_flow.flow(), 1.5, 1.5, opposite);
    ASSERT_GE(told.ends.size(), 2U) << command;
  }
}

TEST(StateFlight, FollowsAHeadingAlongABorderInBothCells) {
  Plan plan = empty_plan(6, 2, 1.0, 2.0);
  for (int ix = 0; ix < 6; ++ix) {
    plan.heading_rad[plan.grid.index({ix, 0})] = -0.5F;
    plan.heading_rad[plan.grid.index({ix, 1})] = 0.5F;
  }
  const PlanFlow plan_flow(plan);
  const Flow flow = plan_flow.flow();
  const Told told = told_of(flow, 1.5, 1.0, 0.0);
  bool lower = false;
  bool upper = false;
  for (const Told::Arrival& a : told.arrivals) {
    (a.section / 4 < 6 ? lower : upper) = true;
  }
  for (const Told::End& end : told.ends) {
    ASSERT_EQ(end.verdict, Verdict::leave);
  }
  EXPECT_TRUE(lower && upper) << told.text();
}

TEST(StateFlight, AnswersLeaveOutsideTheGridAndReachInATarget) {
  Plan plan = empty_plan(3, 3, 1.0, 2.0);
  plan.region[4] = Region::goal;
  const PlanFlow plan_flow(plan);
  const Flow flow = plan_flow.flow();
  for (const Start s : {Start{-5.0, 1.0, 0.0}, Start{1.0, 1e6, 2.0}, Start{3.5, 3.5, -2.0}}) {
    const Told told = told_of(flow, s.x_m, s.y_m, s.heading_rad);
    ASSERT_FALSE(told.ends.empty());
    EXPECT_TRUE(told.arrivals.empty() && !told.gave_up);
    for (const Told::End& end : told.ends) {
      EXPECT_EQ(end.verdict, Verdict::leave);
      EXPECT_EQ(end.length_m, 0.0);
    }
  }
  const Told inside = told_of(flow, 1.5, 1.5, 0.3);
  ASSERT_EQ(inside.ends.size(), 1U);
  EXPECT_EQ(inside.ends[0].verdict, Verdict::reach);
  EXPECT_TRUE(inside.arrivals.empty());
}

}  // namespace
}  // namespace fairway
