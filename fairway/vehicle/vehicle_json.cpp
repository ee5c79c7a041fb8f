#include "fairway/vehicle/vehicle_json.hpp"

#include "fairway/base/strict_json.hpp"

namespace fairway {

using nlohmann::json;

json json_of(const Vehicle& vehicle) {
  return {{"speed_mps", vehicle.speed_mps}, {"turn_radius_m", vehicle.turn_radius_m}};
}

Vehicle vehicle_of(const json& value, const std::string& where) {
  require_known_keys(value, {"speed_mps", "turn_radius_m"}, where);
  return {finite_number(value, "speed_mps", where), finite_number(value, "turn_radius_m", where)};
}

}  // namespace fairway
