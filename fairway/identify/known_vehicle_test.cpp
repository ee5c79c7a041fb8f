#include "fairway/identify/known_vehicle.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/identify/rounded_out.hpp"

namespace fairway {
namespace {

KnownVehicle banked() {
  KnownVehicle v;
  v.airspeed_mps = 22.0;
  v.bank_limit_rad = 35.0 * pi / 180.0;
  return v;
}

TEST(KnownVehicle, TheThreeWaysToSayATurnAgree) {
  KnownVehicle by_rate;
  by_rate.airspeed_mps = 22.0;
  by_rate.turn_rate_radps = 22.0 / still_air_radius_m(banked());
  KnownVehicle by_radius;
  by_radius.airspeed_mps = 22.0;
  by_radius.turn_radius_m = still_air_radius_m(banked());
  EXPECT_NEAR(still_air_radius_m(banked()), 70.49, 0.01);  // 22^2 / (9.80665 tan 35 deg)
  EXPECT_EQ(contract_of(by_rate).contract, contract_of(banked()).contract);
  EXPECT_EQ(contract_of(by_radius).contract, contract_of(banked()).contract);
}

TEST(KnownVehicle, NeitherOrTwoWaysAreRefused) {
  KnownVehicle none;
  EXPECT_THROW(static_cast<void>(contract_of(none)), PreconditionViolation);
  KnownVehicle two = banked();
  two.turn_radius_m = 70.0;
  EXPECT_THROW(static_cast<void>(contract_of(two)), PreconditionViolation);
}

TEST(KnownVehicle, WorkedByHand) {
  KnownVehicle v;
  v.airspeed_mps = 20.0;
  v.turn_radius_m = 50.0;
  v.radius_spread = 0.0;
  v.speed_spread = 0.0;
  v.wind_mps = 5.0;
  v.delay_s = 0.2;
  v.control_period_s = 0.1;
  v.bank_lag_s = 0.3;
  v.position_error_m = 2.0;
  const VehicleContract c = contract_of(v).contract;
  EXPECT_DOUBLE_EQ(c.command_error_m, 27.0);      // 2 + 25 (0.2 + 0.1 + 0.3 + 0.4)
  EXPECT_DOUBLE_EQ(c.turn_radius_m.least, 28.1);  // 50 0.75^2 = 28.125
  EXPECT_DOUBLE_EQ(c.turn_radius_m.most, 78.2);   // 50 1.25^2 = 78.125
  EXPECT_EQ(c.speed_mps, (SizeRange{15.0, 25.0}));
  EXPECT_DOUBLE_EQ(c.heading_error_rad, 0.0332);  // 1.9 degrees
}

TEST(KnownVehicle, AHeadingHeldDriftsWithTheWind) {
  KnownVehicle v = banked();
  v.speed_spread = 0.0;
  v.wind_mps = 11.0;
  v.holds = HeldDirection::heading;
  EXPECT_NEAR(contract_of(v).contract.heading_error_rad, (30.0 + 1.0) * pi / 180.0, 0.001);
}

TEST(KnownVehicle, MoreOfAnyErrorNeverTightensTheContract) {
  Random draw(11);
  for (int k = 0; k < 300; ++k) {
    KnownVehicle v = banked();
    v.wind_mps = draw.uniform(0.0, 8.0);
    v.delay_s = draw.uniform(0.0, 1.0);
    v.position_error_m = draw.uniform(0.0, 5.0);
    KnownVehicle worse = v;
    double* const numbers[] = {&worse.wind_mps,          &worse.delay_s,
                               &worse.control_period_s,  &worse.position_error_m,
                               &worse.heading_error_rad, &worse.radius_spread,
                               &worse.speed_spread};
    *numbers[draw.below(7)] += draw.uniform(0.0, 0.1);
    EXPECT_TRUE(is_within(contract_of(v).contract, contract_of(worse).contract)) << k;
  }
}

TEST(RoundedOut, NeverTightensAndKeepsThreeDigits) {
  Random draw(3);
  for (int k = 0; k < 2000; ++k) {
    const double value = std::pow(10.0, draw.uniform(-6.0, 6.0));
    EXPECT_GE(rounded_out(value, true), value * (1.0 - 2e-9));
    EXPECT_LE(rounded_out(value, true), value * 1.0101);
    EXPECT_LE(rounded_out(value, false), value * (1.0 + 2e-9));
    EXPECT_GE(rounded_out(value, false), value * 0.989);
  }
  EXPECT_EQ(rounded_out(0.0, true), 0.0);
  EXPECT_EQ(rounded_out(7.8, true), 7.8);
  EXPECT_EQ(rounded_out(0.03321, true), 0.0333);
}

}  // namespace
}  // namespace fairway
