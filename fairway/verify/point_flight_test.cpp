#include "fairway/verify/point_flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "fairway/base/random.hpp"
#include "fairway/verify/state_flight.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/testing/told_flights.hpp"

namespace fairway {
namespace {

struct Counts {
  int sure = 0;
  int all = 0;
};

/// Whatever is reported for the state is what the flight in 237 bits meets.
void expect_right(const Flow& flow, const WideCommands<Wide>& commands, Random& random, double x_m,
                  double y_m, double heading_rad, const std::string& name, Counts& counts) {
  Told told;
  ++counts.all;
  if (!follow_point(flow, x_m, y_m, heading_rad, told)) {
    EXPECT_TRUE(told.nothing()) << name;
    return;
  }
  ++counts.sure;
  ASSERT_EQ(told.arrivals.size() + told.ends.size(), 1U);
  ASSERT_FALSE(told.gave_up);
  const int ix = static_cast<int>(std::floor((x_m - flow.grid.x0_m) / flow.grid.cell_m));
  const int iy = static_cast<int>(std::floor((y_m - flow.grid.y0_m) / flow.grid.cell_m));
  const CellKind kind = flow.kind_at({ix, iy});
  WideMeeting<Wide> met;
  if (kind == CellKind::ordinary) {
    const Wide d(flow.grid.cell_m);
    const WideVec<Wide> p{Wide(x_m) - (Wide(flow.grid.x0_m) + Wide(ix) * d),
                          Wide(y_m) - (Wide(flow.grid.y0_m) + Wide(iy) * d)};
    WideFlight<Wide> flight(commands, ix, iy, p, wide_unit<Wide>(heading_rad),
                            [&](std::size_t n) { return random.below(n); });
    met = flight.fly(300);
  } else {
    met.end = kind == CellKind::obstacle ? Verdict::collide
              : kind == CellKind::target ? Verdict::reach
                                         : Verdict::leave;
  }
  EXPECT_TRUE(told.has(met)) << name << ": " << x_m << "," << y_m << "," << heading_rad << " met "
                             << text_of(met) << told.text();
}

TEST(PointFlight, ReportsWhatTheExactFlightMeetsWhereverItIsSure) {
  Random random(1);
  Counts counts;
  for (std::uint64_t number = 0; number < 150; ++number) {
    const Plan plan = random_plan(number);
    const PlanFlow plan_flow(plan);
    const Flow flow = plan_flow.flow();
    const WideCommands<Wide> commands(flow);
    for (int i = 0; i < 300; ++i) {
      const double x = flow.grid.x0_m + random.uniform(-0.2, flow.grid.nx + 0.2) * flow.grid.cell_m;
      const double y = flow.grid.y0_m + random.uniform(-0.2, flow.grid.ny + 0.2) * flow.grid.cell_m;
      expect_right(flow, commands, random, x, y, random.uniform(-pi, pi),
                   "plan " + std::to_string(number), counts);
      if (::testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(counts.sure, counts.all / 2);
}

/// States flown backwards from a corner, a tangent to a border, or an alignment on a border, so
/// that the event lies at a distance `off` from the degenerate one.
TEST(PointFlight, IsNotSureInCloseCasesAndRightWhereItIsSure) {
  Random random(2);
  Counts counts;
  Counts far;
  for (int i = 0; i < 10000; ++i) {
    Plan plan = empty_plan(5, 5, 1.0, random.uniform(1.06, 4.0));
    const float command = Heading::stored(random.uniform(-pi, pi));
    plan.heading_rad.assign(plan.grid.size(), command);
    for (std::size_t c = 0; c < plan.grid.size(); ++c) {
      if (random.below(4) == 0 && c != 12) plan.region[c] = Region::obstacle;
    }
    const PlanFlow plan_flow(plan);
    const Flow flow = plan_flow.flow();
    const WideCommands<Wide> commands(flow);
    // Backwards along the circle of a turn from a corner of the middle cell, by less than a cell.
    const double r = plan.vehicle.turn_radius_m;
    const int turn = random.below(2) == 0 ? 1 : -1;
    const double at = random.below(3) == 0 ? (static_cast<double>(random.below(4)) - 1.0) * pi / 2
                                           : random.uniform(-pi, pi);
    const double back = random.uniform(0.05, 0.6) / r;
    const double h = at - turn * back;
    const double exponent = random.uniform(-16.0, -1.0);
    const double off = std::pow(10.0, exponent) * (random.below(2) == 0 ? 1.0 : -1.0);
    const double corner_x = 2.0 + static_cast<double>(random.below(2));
    const double corner_y = 2.0 + static_cast<double>(random.below(2));
    const double x = corner_x + off - turn * r * (std::sin(at) - std::sin(h));
    const double y = corner_y + off * 0.7 + turn * r * (std::cos(at) - std::cos(h));
    expect_right(flow, commands, random, x, y, h, "off " + std::to_string(exponent),
                 exponent < -3.0 ? counts : far);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(far.sure, far.all / 3);
}

TEST(PointFlight, CrossesManyCellsWithoutACommandAsStraightAsTheExactFlight) {
  Random random(3);
  Counts counts;
  for (int i = 0; i < 60; ++i) {
    Plan plan = empty_plan(60, 50, random.uniform(0.1, 9.0), 20.0);
    for (std::size_t c = 0; c < plan.grid.size(); ++c) {
      const bool silent = random.below(40) != 0;
      plan.heading_rad[c] = silent ? NAN : Heading::stored(random.uniform(-pi, pi));
      if (random.below(100) == 0) plan.region[c] = Region::obstacle;
    }
    const PlanFlow plan_flow(plan);
    const Flow flow = plan_flow.flow();
    const WideCommands<Wide> commands(flow);
    for (int k = 0; k < 100; ++k) {
      const double x = flow.grid.x0_m + random.uniform(0.0, flow.grid.nx) * flow.grid.cell_m;
      const double y = flow.grid.y0_m + random.uniform(0.0, flow.grid.ny) * flow.grid.cell_m;
      expect_right(flow, commands, random, x, y, random.uniform(-pi, pi), "silent", counts);
      if (::testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(counts.sure, counts.all * 9 / 10);
}

TEST(PointFlight, LeavesBordersTiesAndCellsAsLargeAsTheRadiusToOthers) {
  const Plan plan = empty_plan(4, 4, 1.0, 2.0);
  const PlanFlow plan_flow(plan);
  const Flow flow = plan_flow.flow();  // commands of 0 rad
  Told told;
  EXPECT_FALSE(follow_point(flow, 1.0, 1.5, 0.5, told));         // on a border
  EXPECT_FALSE(follow_point(flow, 1.5, 1.5, 0.0, told));         // aligned
  EXPECT_FALSE(follow_point(flow, 1.5, 1.5, pi, told));          // opposite
  EXPECT_FALSE(follow_point(flow, 1.5, 1.5, pi - 1e-9, told));   // almost
  EXPECT_FALSE(follow_point(flow, 1.5, 2.0 - 1e-9, 0.5, told));  // next to a border
  const Plan coarse = empty_plan(4, 4, 1.0, 1.01);
  const PlanFlow coarse_flow(coarse);
  EXPECT_FALSE(follow_point(coarse_flow.flow(), 1.5, 1.5, 0.5, told));
  EXPECT_TRUE(told.nothing());
  EXPECT_TRUE(follow_point(flow, 1.5, 1.5, 0.2, told));
  EXPECT_EQ(told.arrivals.size(), 1U);
}

TEST(PointFlight, IsNotSureWithinTheMarginOfACorner) {
  Plan plan = empty_plan(4, 4, 1.0, 2.0);
  plan.heading_rad.assign(plan.grid.size(), NAN);
  const PlanFlow plan_flow(plan);
  for (const double off : {0x1p-15, -0x1p-15, 0x1p-20, 0x1p-40, 0.0}) {
    Told told;
    EXPECT_FALSE(follow_point(plan_flow.flow(), 1.5 + off, 1.5, pi / 4, told)) << off;
    EXPECT_FALSE(follow_point(plan_flow.flow(), 1.5 + off, 1.5, -3 * pi / 4, told)) << off;
  }
  Told told;
  EXPECT_TRUE(follow_point(plan_flow.flow(), 1.5 + 0x1p-10, 1.5, pi / 4, told));
}

}  // namespace
}  // namespace fairway
