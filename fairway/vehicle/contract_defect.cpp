#include "fairway/vehicle/contract_defect.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/vehicle/size_range.hpp"

namespace fairway {
namespace {

using Defect = std::optional<ContractDefect>;

Defect defect_of_amount(const char* key, double value, const char* unit) {
  if (value >= 0.0 && value <= size_range::most) return {};
  return ContractDefect{key, fmt::format("is {} {}, expected 0 to {}", value, unit, "1e15")};
}

/// "; 90 degrees are 1.5708 rad", for an angle that may have been meant so.
std::string in_radians(double value) {
  if (!(value > 1.0 && value <= 360.0)) return {};
  return fmt::format("; {0} degrees are {1:.5g} rad", value, value * (pi / 180.0));
}

Defect defect_of_angle(const char* key, double value, bool holds, const char* expected) {
  if (holds) return {};
  return ContractDefect{
      key, fmt::format("is {} rad, expected {}{}", value, expected, in_radians(value))};
}

/// With more, the band about every command is so wide that a vehicle in it may be turned out of it
/// to either side (inclusion/parts.hpp: every part is wild).
Defect defect_of_heading_error(const VehicleContract& c) {
  const double error = c.heading_error_rad;
  const double most = std::min(c.hold_side_rad, 0.5 * (pi - c.side_uncertain_rad));
  if (error >= 0.0 && error < most) return {};
  return ContractDefect{
      "heading_error_rad",
      fmt::format("is {} rad, expected at least 0 and less than {:.5g}: with more, a vehicle may "
                  "turn either way everywhere{}",
                  error, most, in_radians(error))};
}

Defect defect_of_range(const char* key, SizeRange range, const char* unit, double nominal) {
  const std::string shown = fmt::format("[{}, {}] {}", range.least, range.most, unit);
  const auto is_size = [](double x) { return x > 0.0 && x <= size_range::most; };
  if (!is_size(range.least) || !is_size(range.most)) {
    return ContractDefect{
        key, fmt::format("is {}, expected two numbers above 0 and at most 1e15", shown)};
  }
  if (range.least > range.most) {
    return ContractDefect{key, fmt::format("is {}, expected the smaller number first: [{}, {}]",
                                           shown, range.most, range.least)};
  }
  if (range.least > nominal || range.most < nominal) {
    return ContractDefect{key, fmt::format("is {} and does not contain the plan's {} {}, expected "
                                           "a range that contains it, such as [{}, {}]",
                                           shown, nominal, unit, std::min(range.least, nominal),
                                           std::max(range.most, nominal))};
  }
  return {};
}

Defect defect_of_wind(double wind_mps, double least_speed_mps) {
  if (wind_mps < least_speed_mps) return defect_of_amount("wind_mps", wind_mps, "m/s");
  return ContractDefect{"wind_mps", fmt::format("is {} m/s, expected less than the least speed, {} "
                                                "m/s: the wind carries a slower vehicle away",
                                                wind_mps, least_speed_mps)};
}

}  // namespace

std::optional<ContractDefect> contract_defect(const VehicleContract& c, const Vehicle& nominal) {
  const double hold = c.hold_side_rad;
  const double either = c.side_uncertain_rad;
  for (const Defect& defect :
       {defect_of_amount("command_error_m", c.command_error_m, "m"),
        defect_of_amount("look_ahead_m", c.look_ahead_m, "m"),
        defect_of_range("turn_radius_m", c.turn_radius_m, "m", nominal.turn_radius_m),
        defect_of_range("speed_mps", c.speed_mps, "m/s", nominal.speed_mps),
        defect_of_angle("hold_side_rad", hold, hold > 0.0 && hold <= pi,
                        "more than 0 and at most half a turn, 3.14159265"),
        defect_of_angle("side_uncertain_rad", either, either >= 0.0 && either <= 0.5 * pi,
                        "at least 0 and at most a quarter turn, 1.5708"),
        defect_of_heading_error(c), defect_of_wind(c.wind_mps, c.speed_mps.least)}) {
    if (defect) return defect;
  }
  return {};
}

void require_contract(const VehicleContract& contract, const Vehicle& nominal,
                      const std::string& where) {
  if (const Defect defect = contract_defect(contract, nominal)) {
    throw InputError(where + "." + defect->key, defect->what);
  }
}

}  // namespace fairway
