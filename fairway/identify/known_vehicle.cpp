#include "fairway/identify/known_vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/identify/rounded_out.hpp"

namespace fairway {
namespace {

constexpr double gravity_mps2 = 9.80665;
constexpr double degrees = 180.0 / pi;
/// What rolling into a turn adds to the lag of the bank; 0.2 to 0.4 s were seen (docs/contract.md).
constexpr double roll_in_s = 0.4;
/// Course held in steady wind: 0.4 to 0.9 degrees were seen.
constexpr double course_hold_in_wind_rad = 0.9 / degrees;

double up(double value) { return rounded_out(value, true); }
double down(double value) { return rounded_out(value, false); }

std::string radius_words(const KnownVehicle& v) {
  if (v.bank_limit_rad) {
    return fmt::format("v^2 / (g tan bank) = {:.3g} m at {:.3g} m/s and a bank of {:.3g} degrees",
                       still_air_radius_m(v), v.airspeed_mps, *v.bank_limit_rad * degrees);
  }
  if (v.turn_rate_radps) {
    return fmt::format("v / turn rate = {:.3g} m at {:.3g} m/s and {:.3g} degrees a second",
                       still_air_radius_m(v), v.airspeed_mps, *v.turn_rate_radps * degrees);
  }
  return fmt::format("{:.3g} m, as given", *v.turn_radius_m);
}

/// The way flown before a command is obeyed.
struct Answer {
  double time_s = 0.0;
  double way_m = 0.0;
  std::string words;
};

Answer answer_of(const KnownVehicle& v, double fastest_mps) {
  const double roll_s = v.bank_lag_s ? *v.bank_lag_s + roll_in_s : 0.0;
  Answer answer;
  answer.time_s = v.delay_s + v.control_period_s + roll_s;
  answer.way_m = answer.time_s * fastest_mps;
  answer.words =
      fmt::format("delay {:.3g} s + control period {:.3g} s", v.delay_s, v.control_period_s);
  if (v.bank_lag_s) {
    answer.words += fmt::format(" + roll-in {:.3g} s (bank lag {:.3g} s and {:.3g} s)", roll_s,
                                *v.bank_lag_s, roll_in_s);
  }
  return answer;
}

void fill_heading_error(const KnownVehicle& v, ExplainedContract& e) {
  double error_rad = v.heading_error_rad;
  e.heading_error = fmt::format("sensor and control {:.3g} degrees", v.heading_error_rad * degrees);
  if (v.wind_mps > 0.0 && v.holds == HeldDirection::course) {
    error_rad += course_hold_in_wind_rad;
    e.heading_error += fmt::format(" + {:.3g} degrees of a course held in steady wind",
                                   course_hold_in_wind_rad * degrees);
  } else if (v.wind_mps > 0.0) {
    const double crab_rad = std::asin(v.wind_mps / ((1.0 - v.speed_spread) * v.airspeed_mps));
    error_rad += crab_rad;
    e.heading_error += fmt::format(
        " + asin(wind / airspeed) = {:.3g} degrees, for a heading is held and the course drifts",
        crab_rad * degrees);
  }
  e.contract.heading_error_rad = up(error_rad);
  e.heading_error += fmt::format(": {:.3g} degrees", error_rad * degrees);
  e.heading_error += ".\nGusts add 2 degrees (light) to 5 (moderate) for a small aircraft";
}

void fill_radius_and_speed(const KnownVehicle& v, ExplainedContract& e) {
  const double radius_m = still_air_radius_m(v);
  VehicleContract air;
  air.turn_radius_m = {(1.0 - v.radius_spread) * radius_m, (1.0 + v.radius_spread) * radius_m};
  air.speed_mps = {(1.0 - v.speed_spread) * v.airspeed_mps,
                   (1.0 + v.speed_spread) * v.airspeed_mps};
  air.wind_mps = v.wind_mps;
  const VehicleContract ground = over_ground(air);
  e.contract.turn_radius_m = {down(ground.turn_radius_m.least), up(ground.turn_radius_m.most)};
  e.contract.speed_mps = {down(ground.speed_mps.least), up(ground.speed_mps.most)};
  e.turn_radius = radius_words(v) + fmt::format(", give or take {:.3g} %", 100.0 * v.radius_spread);
  e.speed =
      fmt::format("{:.3g} m/s, give or take {:.3g} %", v.airspeed_mps, 100.0 * v.speed_spread);
  if (v.wind_mps > 0.0) {
    e.turn_radius += fmt::format(
        ";\nover ground times (1 - w)^2 to (1 + w)^2, with w = wind / least airspeed = {:.2g}",
        v.wind_mps / air.speed_mps.least);
    e.speed += fmt::format(", and the wind of {:.3g} m/s with or against it", v.wind_mps);
  }
  e.speed += "; for bounds of time only";
}

}  // namespace

double still_air_radius_m(const KnownVehicle& v) {
  if (v.bank_limit_rad) {
    return v.airspeed_mps * v.airspeed_mps / (gravity_mps2 * std::tan(*v.bank_limit_rad));
  }
  return v.turn_rate_radps ? v.airspeed_mps / *v.turn_rate_radps : v.turn_radius_m.value_or(0.0);
}

ExplainedContract contract_of(const KnownVehicle& v) {
  const int sizes =
      (v.bank_limit_rad ? 1 : 0) + (v.turn_rate_radps ? 1 : 0) + (v.turn_radius_m ? 1 : 0);
  require(sizes == 1, "exactly one of bank limit, turn rate and turning radius is given");
  require(v.wind_mps < (1.0 - v.speed_spread) * v.airspeed_mps,
          "the wind is below the least speed");
  ExplainedContract e;
  e.about = {
      "From what is known of the vehicle. Fly it, and hold the contract against the logs:",
      "fairway contract --log FLIGHT.csv --contract FILE.toml",
      fmt::format("A plan for it: speed_mps = {:.4g}, turn_radius_m = {:.4g}, or others within "
                  "the ranges below.",
                  v.airspeed_mps, still_air_radius_m(v))};
  fill_radius_and_speed(v, e);
  fill_heading_error(v, e);
  const Answer answer = answer_of(v, e.contract.speed_mps.most);
  e.contract.command_error_m = up(v.position_error_m + answer.way_m);
  e.command_error = fmt::format("position error {:.3g} m + {:.3g} s at {:.3g} m/s = {:.3g} m:\n{}",
                                v.position_error_m, answer.time_s, e.contract.speed_mps.most,
                                answer.way_m, answer.words);
  const double turned_rad = answer.way_m / e.contract.turn_radius_m.least;
  e.contract.side_uncertain_rad = std::min(up(turned_rad), 1.57);
  e.side_uncertain = fmt::format(
      "turned meanwhile at the least radius, {:.3g} degrees: the side was chosen before",
      e.contract.side_uncertain_rad * degrees);
  return e;
}

}  // namespace fairway
