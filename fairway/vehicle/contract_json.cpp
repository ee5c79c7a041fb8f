#include "fairway/vehicle/contract_json.hpp"

#include "fairway/base/error.hpp"
#include "fairway/base/strict_json.hpp"

namespace fairway {
namespace {

using nlohmann::json;

SizeRange range_of(const json& object, const char* key, const std::string& where) {
  const json& value = member(object, key, where);
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
    throw InputError(where + "." + key, "expected [least, most], found " + shown(value));
  }
  return {value[0].get<double>(), value[1].get<double>()};
}

}  // namespace

json json_of(const VehicleContract& c) {
  return {{"command_error_m", c.command_error_m},
          {"look_ahead_m", c.look_ahead_m},
          {"heading_error_rad", c.heading_error_rad},
          {"turn_radius_m", {c.turn_radius_m.least, c.turn_radius_m.most}},
          {"speed_mps", {c.speed_mps.least, c.speed_mps.most}},
          {"hold_side_rad", c.hold_side_rad},
          {"side_uncertain_rad", c.side_uncertain_rad},
          {"wind_mps", c.wind_mps}};
}

VehicleContract contract_of(const json& value, const std::string& where) {
  require_known_keys(value,
                     {"command_error_m", "look_ahead_m", "heading_error_rad", "turn_radius_m",
                      "speed_mps", "hold_side_rad", "side_uncertain_rad", "wind_mps"},
                     where);
  return {finite_number(value, "command_error_m", where),
          finite_number(value, "look_ahead_m", where),
          finite_number(value, "heading_error_rad", where),
          range_of(value, "turn_radius_m", where),
          range_of(value, "speed_mps", where),
          finite_number(value, "hold_side_rad", where),
          finite_number(value, "side_uncertain_rad", where),
          finite_number(value, "wind_mps", where)};
}

}  // namespace fairway
