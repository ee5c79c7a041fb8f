#include "fairway/simulate/exact_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <tbb/global_control.h>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

constexpr float no_command = std::numeric_limits<float>::quiet_NaN();

Plan plan_of(int nx, int ny, double cell_m, double turn_radius_m,
             const std::function<float(Vec2)>& heading) {
  Plan plan;
  plan.grid = {nx, ny, 0.0, 0.0, cell_m};
  plan.vehicle = {10.0, turn_radius_m};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    plan.heading_rad.push_back(heading(plan.grid.center(plan.grid.cell_at(i))));
  }
  return plan;
}

State state(double x, double y, double heading_rad) {
  return {{x, y}, Heading::from_rad(heading_rad)};
}

TEST(ExactFlight, CrossesAUniformFieldToTheEdgeInClosedForm) {
  const ExactFlights flights(plan_of(30, 20, 2.0, 5.0, [](Vec2) { return 0.0F; }));
  const FlightRun run = flights.run(state(10.0, 10.0, pi / 2));
  EXPECT_EQ(run.result.outcome, Outcome::leave);
  EXPECT_EQ(run.ended_by, EndedBy::grid_edge);
  // A quarter circle to the right, then 60 - 15 m straight.
  EXPECT_NEAR(run.result.length_m, 5.0 * pi / 2 + 45.0, 1e-12);
  EXPECT_NEAR(run.result.time_s, run.result.length_m / 10.0, 1e-14);
}

TEST(ExactFlight, NeverReachesInACircularVortex) {
  // Leaning inwards by 0.3 rad, else the cells' constant headings carry the vehicle slowly out.
  const Plan plan = plan_of(64, 64, 2.0, 5.0, [](Vec2 p) {
    return Heading::stored(std::atan2(p.y - 64.0, p.x - 64.0) + pi / 2 + 0.3);
  });
  const ExactFlights flights(plan);
  const FlightRun run = flights.run(state(80.0, 64.0, pi / 2));
  EXPECT_EQ(run.result.outcome, Outcome::trapped);
  EXPECT_EQ(run.ended_by, EndedBy::repeating_state);
  EXPECT_EQ(run.result.length_m, std::numeric_limits<double>::infinity());
}

Plan uniform_plan(float heading_rad) {
  return plan_of(32, 32, 2.0, 5.0, [=](Vec2) { return heading_rad; });
}

void set_region(Plan& plan, Cell cell, Region region) {
  plan.region[plan.grid.index(cell)] = region;
}

/// Headings that vary smoothly, towards a goal disc in the middle.
Plan smooth_plan(bool mirrored = false) {
  Plan plan = plan_of(64, 64, 2.0, 5.0, [=](Vec2 p) {
    if (mirrored) p.y = 128.0 - p.y;
    const double to_middle = std::atan2(64.0 - p.y, 64.0 - p.x);
    const float h = Heading::stored(to_middle + 0.7 * std::sin(p.x / 9.0) * std::cos(p.y / 7.0));
    return mirrored ? -h : h;
  });
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    if (norm(plan.grid.center(plan.grid.cell_at(i)) - Vec2{64.0, 64.0}) < 9.0) {
      plan.region[i] = Region::goal;
    }
  }
  return plan;
}

std::vector<State> random_starts(std::size_t count, double side_m, std::uint64_t seed) {
  std::vector<State> starts;
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(0.0, side_m);
    const double y = random.uniform(0.0, side_m);
    starts.push_back(state(x, y, random.uniform(-pi, pi)));
  }
  return starts;
}

TEST(ExactFlight, EndsAtOnceWhereItStartsOutsideInAnObstacleOrInTheGoal) {
  Plan plan = uniform_plan(0.0F);
  set_region(plan, {10, 10}, Region::obstacle);
  set_region(plan, {11, 10}, Region::goal);
  set_region(plan, {20, 20}, Region::goal);
  const ExactFlights flights(plan);
  const auto expect_at_once = [&](const State& start, Outcome outcome) {
    const FlightResult result = flights.fly(start);
    EXPECT_EQ(result.outcome, outcome);
    EXPECT_EQ(result.time_s, 0.0);
    EXPECT_EQ(result.length_m, 0.0);
  };
  expect_at_once(state(-1.0, 5.0, 0.0), Outcome::leave);
  expect_at_once(state(5.0, 64.1, 0.0), Outcome::leave);
  expect_at_once(state(64.0, 5.0, 0.0), Outcome::leave);  // on the edge, outwards
  expect_at_once(state(0.0, 5.0, pi), Outcome::leave);
  expect_at_once(state(0.0, 0.0, -pi / 2), Outcome::leave);
  expect_at_once(state(21.0, 21.0, 1.0), Outcome::collide);     // inside
  expect_at_once(state(20.0, 21.0, pi), Outcome::collide);      // on its border, heading away
  expect_at_once(state(22.0, 22.0, pi / 4), Outcome::collide);  // at its corner, heading away
  expect_at_once(state(22.0, 21.0, 0.0), Outcome::collide);     // also where a goal cell begins
  expect_at_once(state(41.0, 41.0, 1.0), Outcome::reach);
  expect_at_once(state(40.0, 41.0, 0.0), Outcome::reach);  // on its border, heading in
  expect_at_once(state(41.0, 40.0, 0.0), Outcome::reach);  // along it: belongs to both
}

TEST(ExactFlight, StaysInsideWhenItStartsOnTheEdgeHeadingInOrAlong) {
  const ExactFlights flights(uniform_plan(0.0F));
  EXPECT_EQ(flights.fly(state(0.0, 5.0, 0.0)).length_m, 64.0);
  EXPECT_EQ(flights.fly(state(4.0, 0.0, 0.0)).length_m, 60.0);
  EXPECT_EQ(flights.fly(state(4.0, 64.0, 0.0)).length_m, 60.0);
}

TEST(ExactFlight, LeavesAtOnceWhenItStartsAlongTheEdgeAndIsCommandedOut) {
  const ExactFlights up(plan_of(3, 3, 2.0, 5.0, [](Vec2) { return 1.0F; }));
  for (const State& start : {state(3.0, 6.0, 0.0), state(3.0, 6.0, pi), state(6.0, 3.0, pi / 2)}) {
    const FlightRun run = up.run(start);
    EXPECT_EQ(run.result.outcome, Outcome::leave);
    EXPECT_EQ(run.ended_by, EndedBy::grid_edge);
    EXPECT_EQ(run.flown_m, 0.0);
  }
  EXPECT_GT(up.run(state(3.0, 0.0, 0.0)).flown_m, 1.0) << "commanded in";
}

TEST(ExactFlight, CollidesWithTheTouchOfACorner) {
  // Straight up the diagonal, no commands: between two obstacle cells that share a corner, and past
  // a single one.
  for (const bool both : {true, false}) {
    Plan plan = plan_of(32, 32, 2.0, 5.0, [](Vec2) { return no_command; });
    set_region(plan, {10, 9}, Region::obstacle);
    if (both) set_region(plan, {9, 10}, Region::obstacle);
    const ExactFlights flights(plan);
    const FlightResult result = flights.fly(state(20.0, 30.0, -pi / 2));  // along its left border
    EXPECT_EQ(result.outcome, Outcome::collide);
    EXPECT_EQ(result.length_m, both ? 8.0 : 10.0);
    const FlightResult between = flights.fly(state(10.0, 10.0, pi / 4));
    EXPECT_EQ(between.outcome, Outcome::collide);
    EXPECT_NEAR(between.length_m, 10.0 * std::sqrt(2.0), 1e-12);
  }
}

TEST(ExactFlight, CollidesWithEitherCellBeyondACornerItFliesIntoAlongABorder) {
  // Along a border into a corner, in all four directions; of the cells beyond one is an obstacle,
  // the other is a goal cell.
  for (const bool at_end : {false, true}) {
    for (const int dx : {-1, 0, 1}) {
      for (const int dy : {-1, 0, 1}) {
        if ((dx == 0) == (dy == 0)) continue;  // exact in doubles
        // The corner lies at (8, 8), or on the grid's edge ahead.
        const Vec2 corner{at_end && dx != 0 ? 8.0 + 8.0 * dx : 8.0,
                          at_end && dy != 0 ? 8.0 + 8.0 * dy : 8.0};
        const Vec2 start = corner - Vec2{3.0 * dx, 3.0 * dy};
        const double heading_rad = std::atan2(dy, dx);
        for (const int ox : {-1, 0}) {
          for (const int oy : {-1, 0}) {
            Plan plan = plan_of(8, 8, 2.0, 5.0, [](Vec2) { return no_command; });
            const Cell at{static_cast<int>(corner.x / 2.0), static_cast<int>(corner.y / 2.0)};
            const Cell blocked{at.ix + ox, at.iy + oy};
            // Not a cell that it flies through, or along, to the corner.
            if ((dx > 0   ? ox < 0
                 : dx < 0 ? ox == 0
                 : dy > 0 ? oy < 0
                          : oy == 0) &&
                (dy > 0   ? oy < 0
                 : dy < 0 ? oy == 0
                 : dx > 0 ? ox < 0
                          : ox == 0)) {
              continue;
            }
            if (!plan.grid.contains(blocked)) continue;
            for (const int gx : {-1, 0}) {
              for (const int gy : {-1, 0}) {
                const Cell goal{at.ix + gx, at.iy + gy};
                const bool ahead =
                    (dx == 0 || (dx > 0) == (gx == 0)) && (dy == 0 || (dy > 0) == (gy == 0));
                if (ahead && plan.grid.contains(goal)) set_region(plan, goal, Region::goal);
              }
            }
            set_region(plan, blocked, Region::obstacle);
            const FlightResult result =
                ExactFlights(plan).fly(state(start.x, start.y, heading_rad));
            EXPECT_EQ(result.outcome, Outcome::collide)
                << dx << " " << dy << " " << ox << " " << oy << " " << at_end;
            EXPECT_NEAR(result.length_m, 3.0 * std::hypot(dx, dy), 1e-12);
          }
        }
      }
    }
  }
}

TEST(ExactFlight, LeavesFromASource) {
  const ExactFlights flights(plan_of(32, 32, 2.0, 5.0, [](Vec2 p) {
    return Heading::stored(std::atan2(p.y - 32.0, p.x - 32.0));
  }));
  for (const State& start : random_starts(500, 64.0, 21)) {
    EXPECT_EQ(flights.fly(start).outcome, Outcome::leave);
  }
}

/// Below y = 32 steer up by `angle`, above it down: the vehicle weaves along y = 32.
Plan weave_plan(double angle) {
  return plan_of(32, 32, 2.0, 5.0,
                 [=](Vec2 p) { return static_cast<float>(p.y < 32.0 ? angle : -angle); });
}

/// From (0, 32) at heading `a`, the weave's hops are arcs of turn 2 a; the last one is cut.
double weave_length_m(double a, double width_m, double r) {
  const double hop_m = 2.0 * r * std::sin(a);
  const double hops = std::floor(width_m / hop_m);
  const double rest = width_m - hops * hop_m;
  return hops * 2.0 * r * a + r * (a - std::asin(std::sin(a) - rest / r));
}

TEST(ExactFlight, WeavesBetweenOpposingHalfPlanesInClosedForm) {
  const ExactFlights flights(weave_plan(0.5));
  for (const double a : {0.4, 0.1, 0.01, 1e-3, 1e-5}) {
    const FlightRun run = flights.run(state(0.0, 32.0, a));
    EXPECT_EQ(run.result.outcome, Outcome::leave) << a;
    EXPECT_NEAR(run.result.length_m, weave_length_m(a, 64.0, 5.0), 1e-8) << a;
  }
}

TEST(ExactFlight, PassesTheFinestWeavesInNoMoreStepsThanCellsNeed) {
  const ExactFlights flights(weave_plan(0.5));
  for (const double a : {1e-6, 1e-9, 1e-12, 1e-15, 1e-18, 0.0}) {
    const FlightRun run = flights.run(state(0.0, 32.0, a), {0.0, 10000});
    EXPECT_EQ(run.result.outcome, Outcome::leave) << a;
    EXPECT_NEAR(run.result.length_m, 64.0, 1e-9) << a;
  }
}

/// Cell by cell without leaps, from a cell's inside or its left side to the right edge of the grid.
double length_hop_by_hop_m(const Plan& plan, Cell cell, CellState now) {
  const double d = plan.grid.cell_m;
  double length_m = 0.0;
  while (plan.grid.contains(cell)) {
    const auto rad = static_cast<double>(plan.heading_rad[plan.grid.index(cell)]);
    const CellExit exit =
        cross_cell(now, Direction::of(Heading::from_rad(rad)), {d, plan.vehicle.turn_radius_m});
    length_m += exit.length_m();
    now = exit.state;
    if (exit.side == Side::right || exit.side == Side::left) {
      cell.ix += exit.side == Side::right ? 1 : -1;
      now.position_m.x = d - now.position_m.x;
    } else {
      cell.iy += exit.side == Side::top ? 1 : -1;
      now.position_m.y = d - now.position_m.y;
    }
  }
  return length_m;
}

TEST(ExactFlight, NarrowsAWeaveToEverSmallerCommandsWithoutLosingLength) {
  for (const double shrinking : {0.5, 1e-2, 1e-4, 1e-6}) {
    const Plan plan = plan_of(32, 32, 2.0, 5.0, [=](Vec2 p) {
      const double angle = 0.004 * std::pow(1.0 - shrinking, p.x / 2.0);
      return static_cast<float>(p.y < 32.0 ? angle : -angle);
    });
    const FlightRun run = ExactFlights(plan).run(state(0.0, 32.0, 0.3), {0.0, 1000000});
    EXPECT_EQ(run.result.outcome, Outcome::leave);
    const double hops_m =
        length_hop_by_hop_m(plan, {0, 16}, {{0.0, 0.0}, Direction::of(Heading::from_rad(0.3))});
    EXPECT_NEAR(run.result.length_m, hops_m, 1e-9) << shrinking;
  }
}

TEST(ExactFlight, SlidesAlongABorderWhoseCellsBothTurnTowardsIt) {
  const ExactFlights flights(weave_plan(0.5));
  EXPECT_EQ(flights.fly(state(0.0, 32.0, 0.0)).length_m, 64.0);
  // Both turn away from it: it takes the cell on its left.
  const ExactFlights apart(weave_plan(-0.5));
  const Flight flight = apart.record(state(0.0, 32.0, 0.0));
  EXPECT_GT(flight.segments.front().curvature_per_m, 0.0);
}

TEST(ExactFlight, TurnsLeftWhenTheCommandIsExactlyOpposite) {
  const ExactFlights flights(uniform_plan(0.0F));
  const Flight flight = flights.record(state(32.0, 31.0, pi));
  EXPECT_GT(flight.segments.front().curvature_per_m, 0.0);
  EXPECT_NEAR(flight.segments.front().length_m, 5.0 * pi, 1e-12);
  EXPECT_NEAR(flight.segments.back().start.position_m.y, 21.0, 1e-12);
}

TEST(ExactFlight, ChangesItsLengthContinuouslyWithTheStart) {
  Plan plan = uniform_plan(0.3F);
  const ExactFlights flights(plan);
  Random random(22);
  for (int i = 0; i < 2000; ++i) {
    // Away from the opposite heading and from the grid's edge, where the length jumps.
    const double h = 0.3 + random.uniform(-3.0, 3.0);
    const State start = state(random.uniform(20.0, 40.0), random.uniform(20.0, 40.0), h);
    const State near =
        state(start.position_m.x + random.uniform(-1e-9, 1e-9),
              start.position_m.y + random.uniform(-1e-9, 1e-9), h + random.uniform(-1e-9, 1e-9));
    EXPECT_NEAR(flights.fly(start).length_m, flights.fly(near).length_m, 1e-6);
  }
}

TEST(ExactFlight, FliesTheMirroredPlanAsTheMirrorImage) {
  const ExactFlights flights(smooth_plan());
  const ExactFlights mirrored(smooth_plan(true));
  for (const State& start : random_starts(2000, 128.0, 23)) {
    const FlightResult a = flights.fly(start);
    const FlightResult b =
        mirrored.fly(state(start.position_m.x, 128.0 - start.position_m.y, -start.heading.rad()));
    ASSERT_EQ(a.outcome, b.outcome);
    ASSERT_NEAR(a.length_m, b.length_m, 1e-8);
  }
}

TEST(ExactFlight, AgreesWithSmallStepsOfTheDifferentialEquation) {
  const Plan plan = smooth_plan();
  const ExactFlights flights(plan);
  constexpr double step_m = 2e-4;
  constexpr double until_m = 25.0;
  std::vector<double> off_m;
  for (const State& start : random_starts(60, 128.0, 24)) {
    const Flight flight = flights.follow(start, until_m);
    Vec2 p = start.position_m;
    double h = start.heading.rad();
    double flown_m = 0.0;
    for (; flown_m < until_m; flown_m += step_m) {
      const Cell cell = plan.grid.cell_of(p);
      if (!plan.grid.contains(cell)) break;
      const double command = static_cast<double>(plan.heading_rad[plan.grid.index(cell)]);
      const double error = std::remainder(command - h, two_pi);
      h += std::copysign(std::min(std::abs(error), step_m / 5.0), error);
      p = p + step_m * Vec2{std::cos(h), std::sin(h)};
    }
    const FlightSegment& last = flight.segments.back();
    off_m.push_back(norm(state_at(last, last.length_m).position_m - p));
  }
  std::sort(off_m.begin(), off_m.end());
  // The steps' own error; a start next to a watershed (an opposite command) may diverge from it.
  EXPECT_LT(off_m[54], 0.02);
  EXPECT_LT(off_m[30], 2e-3);
}

TEST(ExactFlight, RecordsPiecesThatJoinEndToEndAndAddUp) {
  const ExactFlights flights(smooth_plan());
  for (const State& start : random_starts(300, 128.0, 25)) {
    const Flight flight = flights.record(start);
    double flown_m = 0.0;
    for (std::size_t i = 0; i < flight.segments.size(); ++i) {
      const FlightSegment& piece = flight.segments[i];
      ASSERT_NEAR(piece.time_s * 10.0, flown_m, 1e-9);
      ASSERT_LE(std::abs(piece.curvature_per_m), 1.0 / 5.0);
      flown_m += piece.length_m;
      if (i + 1 == flight.segments.size()) break;
      const State end = state_at(piece, piece.length_m);
      const State next = flight.segments[i + 1].start;
      ASSERT_NEAR(norm(end.position_m - next.position_m), 0.0, 1e-3);  // a leap is drawn straight
      ASSERT_NEAR(end.heading.turn_to(next.heading), 0.0, 0.05);
    }
    if (std::isfinite(flight.result.length_m)) {
      ASSERT_NEAR(flown_m, flight.result.length_m, 1e-5 * flown_m);
    }
    ASSERT_EQ(flight.result.length_m, flights.fly(start).length_m);
  }
}

TEST(ExactFlight, FollowsOnThroughGoalCellsForTheLengthAsked) {
  Plan plan = uniform_plan(0.0F);
  set_region(plan, {10, 10}, Region::goal);
  const Flight flight = ExactFlights(plan).follow(state(5.0, 21.0, 0.0), 40.0);
  EXPECT_EQ(flight.result.outcome, Outcome::reach);
  EXPECT_EQ(flight.result.length_m, 15.0);
  ASSERT_EQ(flight.segments.size(), 1U);
  EXPECT_EQ(flight.segments.front().length_m, 40.0);
}

TEST(ExactFlight, TellsARepeatingStateFromALimit) {
  // A command that turns with the vehicle can never be met: a full circle, again and again.
  const ExactFlights circling(plan_of(64, 64, 2.0, 5.0, [](Vec2 p) {
    return Heading::stored(std::atan2(p.y - 64.0, p.x - 64.0) + pi / 2 + 0.3);
  }));
  const State start = state(80.0, 64.0, pi / 2);
  EXPECT_EQ(circling.run(start).ended_by, EndedBy::repeating_state);
  EXPECT_EQ(circling.run(start, {50.0, 0}).ended_by, EndedBy::length_limit);
  EXPECT_EQ(circling.run(start, {0.0, 7}).ended_by, EndedBy::crossing_limit);
  EXPECT_EQ(circling.run(start, {0.0, 7}).result.outcome, Outcome::trapped);
}

TEST(ExactFlight, GivesTheSameResultsOnAnyNumberOfThreads) {
  const ExactFlights flights(smooth_plan());
  const std::vector<State> starts = random_starts(2000, 128.0, 26);
  const std::vector<FlightResult> together = flights.fly_all(starts);
  std::vector<FlightResult> alone;
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    alone = flights.fly_all(starts);
  }
  for (std::size_t i = 0; i < starts.size(); ++i) {
    ASSERT_EQ(together[i].outcome, alone[i].outcome);
    ASSERT_EQ(together[i].length_m, alone[i].length_m);
  }
}

TEST(ExactFlight, RefusesCellsNotSmallerThanTheTurningRadius) {
  EXPECT_THROW(ExactFlights(plan_of(4, 4, 5.0, 5.0, [](Vec2) { return 0.0F; })),
               PreconditionViolation);
}

}  // namespace
}  // namespace fairway
