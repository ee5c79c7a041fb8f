#include "fairway/inclusion/parts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fairway/base/random.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

TEST(HeadingArc, AnglesAreCountedFromZeroAsFmodDoes) {
  Random random(3);
  for (int k = 0; k < 20000; ++k) {
    double angle = random.uniform(-40.0, 40.0);
    if (k % 4 == 0)
      angle = whole_turn_rad * static_cast<double>(random.below(9)) - 4.0 * whole_turn_rad;
    if (k % 8 == 0) angle = std::nextafter(angle, k % 16 == 0 ? 100.0 : -100.0);
    const double rest = std::fmod(angle, whole_turn_rad);
    ASSERT_EQ(counted_from_zero(angle), rest < 0.0 ? rest + whole_turn_rad : rest) << angle;
  }
}

constexpr float no_command = std::numeric_limits<float>::quiet_NaN();

TEST(FilledCommands, ACellWithoutACommandHasThatOfTheNearestFirstOfEquals) {
  Random random(4);
  for (int round = 0; round < 60; ++round) {
    Plan plan = empty_plan(1 + static_cast<int>(random.below(12)),
                           1 + static_cast<int>(random.below(9)), 1.0, 2.0);
    for (float& h : plan.heading_rad) {
      h = random.below(5) == 0 ? static_cast<float>(random.uniform(-3.0, 3.0)) : no_command;
    }
    const auto filled = filled_commands(plan.grid, plan.heading_rad.data());
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      const Cell c = plan.grid.cell_at(i);
      int best = 1 << 30;
      float wanted = no_command;
      for (std::size_t j = 0; j < plan.grid.size(); ++j) {
        const Cell o = plan.grid.cell_at(j);
        const int d = (o.ix - c.ix) * (o.ix - c.ix) + (o.iy - c.iy) * (o.iy - c.iy);
        if (!std::isnan(plan.heading_rad[j]) && d < best) {
          best = d;
          wanted = plan.heading_rad[j];
        }
      }
      ASSERT_EQ(std::isnan(filled[i]), std::isnan(wanted));
      if (!std::isnan(wanted)) {
        EXPECT_EQ(filled[i], wanted);
      }
    }
  }
}

TEST(Parts, AnArcHoldsEveryCommandThatMayBeInForce) {
  Random random(5);
  std::size_t ordinary = 0;
  for (int round = 0; round < 200; ++round) {
    Plan plan = empty_plan(7, 6, 2.0, 5.0);
    const double spread = random.uniform(0.0, 2.0);
    for (float& h : plan.heading_rad) h = static_cast<float>(3.0 + random.uniform(-spread, spread));
    plan.region[plan.grid.index({3, 3})] = Region::obstacle;
    plan.heading_rad[plan.grid.index({3, 3})] = no_command;
    const PlanFlow held(plan);
    VehicleContract contract = VehicleContract::of(plan.vehicle);
    contract.command_error_m = random.uniform(0.0, 3.0);
    contract.heading_error_rad = random.uniform(0.0, 0.2);
    const int per_cell = 1 + static_cast<int>(random.below(4));
    const Flow flow = held.flow();
    const Parts parts(flow, contract, per_cell);
    const auto filled = filled_commands(plan.grid, plan.heading_rad.data());
    for (int k = 0; k < 300; ++k) {
      const Vec2 p{random.uniform(0.0, plan.grid.width_m()),
                   random.uniform(0.0, plan.grid.height_m())};
      const PartPlace part{static_cast<int>(p.x / parts.part_m()),
                           static_cast<int>(p.y / parts.part_m())};
      if (parts.kind(part) != PartKind::ordinary) continue;
      ++ordinary;
      EXPECT_LT(parts.arc(part).width_rad, pi);
      const double angle = random.uniform(-pi, pi);
      const double far = contract.command_error_m * random.unit();
      const Cell q = plan.grid.cell_of(p + far * Vec2{std::cos(angle), std::sin(angle)});
      const Cell in{std::clamp(q.ix, 0, 6), std::clamp(q.iy, 0, 5)};
      const double command = static_cast<double>(filled[plan.grid.index(in)]);
      const double e = contract.heading_error_rad;
      EXPECT_TRUE(parts.arc(part).meets({command - e, 0.0}));
      EXPECT_TRUE(parts.arc(part).meets({command + e, 0.0}));
    }
  }
  EXPECT_GT(ordinary, 20000U);
}

TEST(Parts, OpposingCommandsMakeAPartWild) {
  Plan plan = empty_plan(4, 1, 1.0, 2.0);
  plan.heading_rad = {0.0F, 0.0F, 3.14159265F, 3.14159265F};
  const PlanFlow held(plan);
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  contract.command_error_m = 0.25;
  const Parts parts(held.flow(), contract, 2);
  const auto kind = [&](int ix) { return parts.kind({ix, 0}); };
  EXPECT_EQ(kind(2), PartKind::ordinary);
  EXPECT_EQ(kind(3), PartKind::wild);
  EXPECT_EQ(kind(4), PartKind::wild);
  EXPECT_EQ(kind(5), PartKind::ordinary);
  EXPECT_EQ(kind(-1), PartKind::outside);
}

}  // namespace
}  // namespace fairway
