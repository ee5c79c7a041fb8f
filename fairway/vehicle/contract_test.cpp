#include "fairway/vehicle/contract.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/vehicle/contract_defect.hpp"
#include "fairway/vehicle/contract_json.hpp"

namespace fairway {
namespace {

constexpr Vehicle vehicle{10.0, 20.0};

VehicleContract drawn(Random& random) {
  VehicleContract c;
  const auto some = [&](double most) { return random.below(3) == 0 ? 0.0 : random.unit() * most; };
  c.command_error_m = some(30.0);
  c.look_ahead_m = some(10.0);
  c.turn_radius_m = {20.0 - some(15.0), 20.0 + some(15.0)};
  c.speed_mps = {10.0 - some(5.0), 10.0 + some(5.0)};
  c.hold_side_rad = pi - some(3.0);
  c.side_uncertain_rad = some(0.5 * pi);
  c.heading_error_rad = some(0.99 * std::min(c.hold_side_rad, 0.5 * (pi - c.side_uncertain_rad)));
  c.wind_mps = some(4.9);
  return c;
}

TEST(Contracts, OverGroundHaveNeitherLookAheadNorWindAndAreWider) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const VehicleContract c = drawn(random);
    const VehicleContract wider = over_ground(c);
    EXPECT_EQ(wider.look_ahead_m, 0.0);
    EXPECT_EQ(wider.wind_mps, 0.0);
    EXPECT_EQ(over_ground(wider), wider);
    VehicleContract here = c;  // is_within() compares contracts of one kind
    here.look_ahead_m = here.wind_mps = 0.0;
    EXPECT_TRUE(is_within(here, wider));
    EXPECT_FALSE(contract_defect(wider, vehicle));
  }
}

TEST(Contracts, OverGroundHoldTheCurvatureAndSpeedOfCirclesInMovingAir) {
  Random random(2);
  double tightest = 1e9;  // of the bound
  double widest = 1e9;
  for (int i = 0; i < 300; ++i) {
    VehicleContract c = drawn(random);
    const VehicleContract wider = over_ground(c);
    for (int k = 0; k < 300; ++k) {
      const double radius =
          c.turn_radius_m.least + random.unit() * (c.turn_radius_m.most - c.turn_radius_m.least);
      const double speed =
          k % 2 == 0 ? c.speed_mps.least
                     : c.speed_mps.least + random.unit() * (c.speed_mps.most - c.speed_mps.least);
      const double wind = k % 3 == 0 ? c.wind_mps : random.unit() * c.wind_mps;
      const double from = random.unit() * 2.0 * pi;
      // Through the air along +x, turning left.
      const Vec2 ground{speed + wind * std::cos(from), wind * std::sin(from)};
      const Vec2 change{0.0, speed * speed / radius};
      const double over = std::hypot(ground.x, ground.y);
      const double curvature = (ground.x * change.y - ground.y * change.x) / (over * over * over);
      ASSERT_GE(1.0 / curvature, wider.turn_radius_m.least * (1.0 - 1e-12));
      ASSERT_LE(1.0 / curvature, wider.turn_radius_m.most * (1.0 + 1e-12));
      ASSERT_GE(over, wider.speed_mps.least * (1.0 - 1e-12));
      ASSERT_LE(over, wider.speed_mps.most * (1.0 + 1e-12));
      if (c.wind_mps < 0.1) continue;
      tightest = std::min(tightest, 1.0 / curvature / wider.turn_radius_m.least - 1.0);
      widest = std::min(widest, 1.0 - 1.0 / curvature / wider.turn_radius_m.most);
    }
  }
  EXPECT_LT(tightest, 0.02);  // the bounds are attained
  EXPECT_LT(widest, 0.02);
}

TEST(Contracts, TheExactVehicleIsWithinEveryContractOfItsKind) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    VehicleContract c = drawn(random);
    c.look_ahead_m = 0.0;
    c.hold_side_rad = VehicleContract{}.hold_side_rad;
    ASSERT_FALSE(contract_defect(c, vehicle));
    EXPECT_TRUE(is_within(VehicleContract::of(vehicle), c));
  }
}

TEST(Contracts, AreReadBackFromJsonAsTheyWere) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const VehicleContract c = drawn(random);
    EXPECT_EQ(contract_of(nlohmann::json::parse(json_of(c).dump()), "p"), c);
  }
}

TEST(Contracts, InJsonLackNoMemberAndHaveNoOther) {
  const nlohmann::json whole = json_of(VehicleContract::of(vehicle));
  const auto complaint = [](const nlohmann::json& value) -> std::string {
    try {
      (void)contract_of(value, "p.contract");
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  for (const auto& [key, value] : whole.items()) {
    nlohmann::json changed = whole;
    changed.erase(key);
    EXPECT_NE(complaint(changed).find(key), std::string::npos) << complaint(changed);
    for (const nlohmann::json& wrong : {nlohmann::json("1"), nlohmann::json(), nlohmann::json{1},
                                        nlohmann::json{1, 2, 3}, nlohmann::json{1, "2"}}) {
      changed[key] = wrong;
      EXPECT_TRUE(complaint(changed).starts_with("p.contract." + key)) << complaint(changed);
    }
  }
  nlohmann::json more = whole;
  more["rho"] = 1.0;
  EXPECT_EQ(complaint(more), "p.contract: has the unknown key \"rho\"");
  EXPECT_EQ(complaint(3), "p.contract: expected a JSON object");
}

TEST(Contracts, ThatNoVehicleKeepsAreRefusedInASentenceWithTheCure) {
  using Change = std::function<void(VehicleContract&)>;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  const struct {
    Change change;
    const char* complaint;
  } cases[] = {
      {[](auto& c) { c.command_error_m = -1; }, "p.command_error_m: is -1 m, expected 0 to 1e15"},
      {[](auto& c) { c.command_error_m = nan; }, "p.command_error_m: is nan m, expected 0 to 1e15"},
      {[](auto& c) { c.look_ahead_m = inf; }, "p.look_ahead_m: is inf m, expected 0 to 1e15"},
      {[](auto& c) { c.heading_error_rad = -0.1; },
       "p.heading_error_rad: is -0.1 rad, expected at least 0 and less than 1.5708: with more, a "
       "vehicle may turn either way everywhere"},
      {[](auto& c) { c.heading_error_rad = 2; },
       "p.heading_error_rad: is 2 rad, expected at least 0 and less than 1.5708: with more, a "
       "vehicle may turn either way everywhere; 2 degrees are 0.034907 rad"},
      {[](auto& c) {
         c.turn_radius_m = {22, 18};
       },
       "p.turn_radius_m: is [22, 18] m, expected the smaller number first: [18, 22]"},
      {[](auto& c) {
         c.turn_radius_m = {0, 22};
       },
       "p.turn_radius_m: is [0, 22] m, expected two numbers above 0 and at most 1e15"},
      {[](auto& c) {
         c.turn_radius_m = {18, nan};
       },
       "p.turn_radius_m: is [18, nan] m, expected two numbers above 0 and at most 1e15"},
      {[](auto& c) {
         c.turn_radius_m = {21, 22};
       },
       "p.turn_radius_m: is [21, 22] m and does not contain the plan's 20 m, expected a range that "
       "contains it, such as [20, 22]"},
      {[](auto& c) {
         c.turn_radius_m = {18, 19};
       },
       "p.turn_radius_m: is [18, 19] m and does not contain the plan's 20 m, expected a range that "
       "contains it, such as [18, 20]"},
      {[](auto& c) {
         c.speed_mps = {11, 9};
       },
       "p.speed_mps: is [11, 9] m/s, expected the smaller number first: [9, 11]"},
      {[](auto& c) {
         c.speed_mps = {11, 12};
       },
       "p.speed_mps: is [11, 12] m/s and does not contain the plan's 10 m/s, expected a range that "
       "contains it, such as [10, 12]"},
      {[](auto& c) { c.hold_side_rad = 0; },
       "p.hold_side_rad: is 0 rad, expected more than 0 and at most half a turn, 3.14159265"},
      {[](auto& c) { c.hold_side_rad = 90; },
       "p.hold_side_rad: is 90 rad, expected more than 0 and at most half a turn, 3.14159265; 90 "
       "degrees are 1.5708 rad"},
      {[](auto& c) { c.side_uncertain_rad = 20; },
       "p.side_uncertain_rad: is 20 rad, expected at least 0 and at most a quarter turn, 1.5708; "
       "20 degrees are 0.34907 rad"},
      {[](auto& c) { c.wind_mps = -2; }, "p.wind_mps: is -2 m/s, expected 0 to 1e15"},
      {[](auto& c) { c.wind_mps = 10; },
       "p.wind_mps: is 10 m/s, expected less than the least speed, 10 m/s: the wind carries a "
       "slower vehicle away"},
      {[](auto& c) { c.wind_mps = nan; }, "p.wind_mps: is nan m/s"},
  };
  for (const auto& [change, complaint] : cases) {
    VehicleContract c = VehicleContract::of(vehicle);
    EXPECT_NO_THROW(require_contract(c, vehicle, "p"));
    change(c);
    try {
      require_contract(c, vehicle, "p");
      ADD_FAILURE() << "accepted: " << complaint;
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(complaint)) << error.what();
    }
  }
}

}  // namespace
}  // namespace fairway
