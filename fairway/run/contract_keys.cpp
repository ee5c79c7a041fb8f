#include "fairway/run/contract_keys.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "fairway/run/scenario_values.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr const char* radius_key = "vehicle.contract.turn_radius_m";
constexpr const char* speed_key = "vehicle.contract.speed_mps";

using fairway::shown;
using fairway::take;
void take(const TomlValue& value, SizeRange& range) {
  const Vec2 pair = value.pair();
  range = {pair.x, pair.y};
}

json shown(SizeRange range) {
  return range == SizeRange{} ? json() : json{range.least, range.most};
}

/// Any finite number is taken: contract_defect() judges it, for it knows the cure.
template <typename T>
ScenarioKey contract_key(std::string name, std::string kind, T VehicleContract::*member,
                         std::string meaning) {
  return {std::move(name),
          std::move(kind),
          Range{},
          false,
          std::move(meaning),
          [member](const TomlValue& v, Scenario& s) {
            if (!s.contract) s.contract.emplace();
            take(v, (*s.contract).*member);
          },
          [member](const Scenario& s) {
            return shown(s.contract.value_or(VehicleContract{}).*member);
          }};
}

}  // namespace

std::vector<ScenarioKey> contract_keys() {
  using Contract = VehicleContract;
  return {
      contract_key("vehicle.contract.command_error_m", "number >= 0", &Contract::command_error_m,
                   "the command in force is that of a place at most this far from the vehicle (or "
                   "from the point ahead of it), metres"),
      contract_key("vehicle.contract.look_ahead_m", "number >= 0", &Contract::look_ahead_m,
                   "the vehicle takes the command of the point this far ahead of it, metres"),
      contract_key("vehicle.contract.heading_error_rad", "number in [0, pi / 2)",
                   &Contract::heading_error_rad,
                   "give or take this, radians; within it of the command the vehicle may weave"),
      contract_key(radius_key, "[least, most]", &Contract::turn_radius_m,
                   "radii at which it turns, metres; holds `vehicle.turn_radius_m`, and without "
                   "the key is that alone"),
      contract_key(speed_key, "[least, most]", &Contract::speed_mps,
                   "speeds over ground, metres per second, for bounds of time; holds "
                   "`vehicle.speed_mps`, and without the key is that alone"),
      contract_key("vehicle.contract.hold_side_rad", "number in (0, pi]", &Contract::hold_side_rad,
                   "while the command is farther than this from the heading, radians, the side "
                   "first turned to is kept"),
      contract_key("vehicle.contract.side_uncertain_rad", "number in [0, pi / 2]",
                   &Contract::side_uncertain_rad,
                   "a turn may begin to either side within this of opposite, radians"),
      contract_key("vehicle.contract.wind_mps", "number >= 0", &Contract::wind_mps,
                   "wind up to this, metres per second, in any direction; radius and speed are "
                   "then those through the air"),
  };
}

void complete_contract(Scenario& scenario) {
  if (!scenario.contract) return;
  const VehicleContract exact = VehicleContract::of(scenario.vehicle);
  if (!scenario.lines.contains(radius_key)) scenario.contract->turn_radius_m = exact.turn_radius_m;
  if (!scenario.lines.contains(speed_key)) scenario.contract->speed_mps = exact.speed_mps;
}

}  // namespace fairway
