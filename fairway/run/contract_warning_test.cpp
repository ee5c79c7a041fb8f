#include "fairway/run/contract_warning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/run/plan_warnings.hpp"

namespace fairway {
namespace {

/// Commands towards a point in the middle of 40 by 30 cells of 2 m.
Plan towards_the_middle() {
  Plan plan;
  plan.grid = {40, 30, 0.0, 0.0, 2.0};
  plan.vehicle = {10.0, 5.0};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Vec2 off = Vec2{40.0, 30.0} - plan.grid.center(plan.grid.cell_at(i));
    plan.heading_rad.push_back(Heading::stored(std::atan2(off.y, off.x)));
  }
  return plan;
}

VehicleContract contract_of(const Plan& plan, double error_m, double heading_error_rad = 0.0) {
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  contract.command_error_m = error_m;
  contract.heading_error_rad = heading_error_rad;
  return contract;
}

/// Whether some direction has every command within a quarter turn of it, with room for the error.
bool fits_into_half_a_turn(const std::vector<double>& commands, double error_rad) {
  return std::any_of(commands.begin(), commands.end(), [&](double first) {
    return std::all_of(commands.begin(), commands.end(), [&](double other) {
      const double turn = std::fmod(other - first + 4.0 * pi, 2.0 * pi);
      return turn < pi - 2.0 * error_rad;
    });
  });
}

TEST(WildShares, CountTheCellsWhereCommandsSpanHalfATurn) {
  const Plan plan = towards_the_middle();
  Random random(3);
  for (int round = 0; round < 12; ++round) {
    const double error_m = random.uniform(0.0, 30.0);
    const double heading_error_rad = random.uniform(0.0, 0.6);
    std::size_t surely = 0;
    std::size_t perhaps = 0;
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      const Vec2 at = plan.grid.center(plan.grid.cell_at(i));
      std::vector<double> commands;
      for (std::size_t j = 0; j < plan.grid.size(); ++j) {
        const Vec2 low = plan.grid.corner(plan.grid.cell_at(j));
        const Vec2 near{std::clamp(at.x, low.x, low.x + 2.0), std::clamp(at.y, low.y, low.y + 2.0)};
        if (norm(near - at) <= error_m) {
          commands.push_back(static_cast<double>(plan.heading_rad[j]));
        }
      }
      constexpr double two_degrees = 2.0 * pi / 180.0;  // commands are rounded to one
      surely += fits_into_half_a_turn(commands, heading_error_rad - 0.5 * two_degrees) ? 0 : 1;
      perhaps += fits_into_half_a_turn(commands, heading_error_rad + 0.5 * two_degrees) ? 0 : 1;
    }
    const double share = wild_share(plan, contract_of(plan, error_m, heading_error_rad));
    const auto all = static_cast<double>(plan.grid.size());
    EXPECT_GE(share, static_cast<double>(surely) / all);
    EXPECT_LE(share, static_cast<double>(perhaps) / all);
  }
}

TEST(ContractWarnings, ComeWithTheErrorThatWouldDo) {
  const Plan plan = towards_the_middle();
  EXPECT_FALSE(contract_warning(plan, contract_of(plan, 2.0, 0.1)));
  const auto warning = contract_warning(plan, contract_of(plan, 30.0, 0.1));
  ASSERT_TRUE(warning);
  EXPECT_TRUE(warning->starts_with("The contract is too wide for this plan: at ")) << *warning;
  EXPECT_NE(warning->find("command_error_m is 30 m"), std::string::npos) << *warning;
  const std::size_t at = warning->find("; ");
  ASSERT_NE(at, std::string::npos) << *warning;
  const double enough = std::stod(warning->substr(at + 2));
  EXPECT_GT(enough, 1.0);
  EXPECT_LE(wild_share(plan, contract_of(plan, enough, 0.1)), 0.01);
  EXPECT_GT(wild_share(plan, contract_of(plan, 2.0 * enough, 0.1)), 0.01);
}

TEST(ContractWarnings, AreOfPlansWithoutCommandsToo) {
  Plan plan = towards_the_middle();
  plan.heading_rad.assign(plan.grid.size(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(wild_share(plan, contract_of(plan, 1.0)), 1.0);
  EXPECT_TRUE(contract_warning(plan, contract_of(plan, 1.0)));
  plan.region.assign(plan.grid.size(), Region::obstacle);
  EXPECT_FALSE(contract_warning(plan, contract_of(plan, 1.0)));
}

TEST(ContractWarnings, StandAmongThoseOfThePlan) {
  Plan plan = towards_the_middle();
  ObstacleMap map;
  map.grid = plan.grid;
  map.obstacle.assign(plan.grid.size(), 0);
  EXPECT_TRUE(plan_warnings({}, map, plan).empty());
  plan.record.contract = contract_of(plan, 30.0);
  EXPECT_EQ(plan_warnings({}, map, plan).size(), 1U);
}

}  // namespace
}  // namespace fairway
