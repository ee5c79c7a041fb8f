#include "fairway/run/replan.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <toml++/toml.h>
#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/run/scenario_keys.hpp"

namespace fairway {
namespace {

using nlohmann::json;

/// Uses the scenario's own reader, so that both know the same keys. Numbers, strings and flags are
/// written alike in JSON and TOML.
void take(const ScenarioKey& key, const json& value, const std::string& where, Scenario& scenario) {
  const toml::table table = toml::parse("value = " + value.dump());
  key.take(TomlValue(*table.get("value"), {where}, "options." + key.name, key.range), scenario);
}

}  // namespace

FieldOptions field_options_of(const PlanRecord& record, const std::string& where) {
  const json all = json::parse(record.options_json, nullptr, false);
  const auto plan = all.is_object() ? all.find("plan") : all.end();
  if (!all.is_object() || plan == all.end() || !plan->is_object()) {
    throw InputError(where, "its record names no options; expected a plan made by fairway");
  }
  Scenario scenario;
  // Plans from before there was a choice have the paper's.
  if (!plan->contains("path_field")) scenario.plan.path_field = PathField::paper;
  const auto& keys = scenario_keys();
  for (const auto& [leaf, value] : plan->items()) {
    const std::string name = "plan." + leaf;
    const auto key =
        std::find_if(keys.begin(), keys.end(), [&](const auto& k) { return k.name == name; });
    if (key == keys.end()) {
      throw InputError(where, fmt::format("options.{}: is not known to this version", name));
    }
    if (value.is_null()) continue;
    try {
      take(*key, value, where, scenario);
    } catch (const toml::parse_error&) {
      throw InputError(where, fmt::format("options.{}: expected {}", name, key->kind));
    }
  }
  return scenario.plan;
}

std::variant<Plan, MissionRefusal> replan(const Plan& plan, const Mission& mission,
                                          const FieldOptions& options) {
  ObstacleMap map;
  map.grid = plan.grid;
  map.frame = frame_in(plan.record);
  map.obstacle.resize(plan.region.size());
  std::transform(plan.region.begin(), plan.region.end(), map.obstacle.begin(),
                 [](Region r) { return static_cast<std::uint8_t>(r == Region::obstacle); });
  FieldOrRefusal answer = compute_field(map, plan.vehicle, mission, options);
  if (auto* refusal = std::get_if<MissionRefusal>(&answer)) return std::move(*refusal);
  PlanRecord record = plan.record;
  record.mission = mission;
  record.improved = {};
  record.modes = {};  // they were chosen for the other mission
  return plan_of_field(std::move(std::get<Field>(answer)), plan.vehicle, std::move(record));
}

}  // namespace fairway
