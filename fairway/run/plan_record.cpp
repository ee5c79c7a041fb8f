#include "fairway/run/plan_record.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/base/digest.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/version.hpp"

namespace fairway {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Relative to the scenario's folder, so that a record does not depend on where a checkout lies.
std::string path_in_record(const fs::path& path, const Scenario& scenario) {
  const fs::path folder = fs::absolute(scenario.file).lexically_normal().parent_path();
  return fs::absolute(path).lexically_normal().lexically_relative(folder).generic_string();
}

std::string text_of(const json& options) {
  return options.dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace

std::vector<InputFile> recorded_inputs(const Scenario& scenario, const ObstacleMap& map) {
  std::vector<InputFile> inputs{{path_in_record(scenario.file, scenario), scenario.sha256}};
  for (const InputFile& input : map.inputs) {
    inputs.push_back({path_in_record(input.path, scenario), input.sha256});
  }
  if (const auto& path = scenario.mission.path_file) {
    inputs.push_back({path_in_record(*path, scenario), sha256_file(*path)});
  }
  return inputs;
}

PlanRecord plan_record(const Scenario& scenario, const ObstacleMap& map, const Mission& mission) {
  json options = {{"map", effective_values(scenario, "map")},
                  {"plan", effective_values(scenario, "plan")}};
  options["map"].erase("file");  // it stands among the inputs
  if (!scenario.only_connected) options["map"].erase("only_connected");  // as records always were
  return {program_version,  mission, map.frame,        recorded_inputs(scenario, map),
          text_of(options), {},      scenario.contract};
}

PlanRecord plan_record(const ObstacleMap& map, const Mission& mission,
                       const FieldOptions& options) {
  Scenario asked;
  asked.plan = options;
  if (std::holds_alternative<PathMission>(mission)) asked.mission.kind = MissionKind::path;
  const json all = {{"plan", effective_values(asked, "plan")}};
  return {program_version, mission, map.frame, map.inputs, text_of(all), {}};
}

}  // namespace fairway
