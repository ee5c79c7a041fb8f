#include "fairway/run/qgc_site.hpp"

#include <system_error>
#include <variant>
#include <vector>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/map/fence_sources.hpp"
#include "fairway/map/json_source.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string text_of(const json& value) { return value.dump(-1, ' ', true); }

/// The .plan among the files that the map was read from. A scenario's record names the scenario
/// first and a path's file last; neither is the map.
std::optional<InputFile> map_plan_of(const PlanRecord& record) {
  if (!record.inputs) return {};
  std::vector<InputFile> inputs = *record.inputs;
  const bool of_scenario = !inputs.empty() && fs::path(inputs.front().path).extension() == ".toml";
  const bool along_path = record.mission && std::holds_alternative<PathMission>(*record.mission);
  if (of_scenario && along_path && inputs.size() > 1) inputs.pop_back();
  for (const InputFile& input : inputs) {
    if (fs::path(input.path).extension() == ".plan") return input;
  }
  return {};
}

bool is_file_of(const fs::path& file, const std::string& sha256) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return false;
  try {
    return sha256_file(file) == sha256;
  } catch (const InputError&) {  // one that cannot be read is not taken
    return false;
  }
}

}  // namespace

QgcSite qgc_site_of(const fs::path& file) {
  const SourceText source = read_source(file);
  if (!trimmed(source.text).starts_with('{')) {
    throw InputError(file.string(), "is not a QGroundControl plan, expected JSON");
  }
  const json plan = parse_json(source);
  (void)read_qgc_plan(source, plan);  // rejects what is not a fence
  QgcSite site;
  if (plan.contains("geoFence") && plan["geoFence"].is_object()) {
    site.fence_json = text_of(plan["geoFence"]);
  }
  if (plan.contains("rallyPoints") && plan["rallyPoints"].is_object()) {
    site.rally_points_json = text_of(plan["rallyPoints"]);
  }
  const json home = plan.value("/mission/plannedHomePosition"_json_pointer, json());
  if (home.is_array() && home.size() == 3 && home[2].is_number()) {
    site.home_altitude_m = home[2].get<double>();
  }
  return site;
}

std::optional<QgcSite> qgc_site_of(const PlanRecord& record, const fs::path& folder) {
  const std::optional<InputFile> input = map_plan_of(record);
  if (!input) return {};
  const fs::path beside = folder.empty() ? "." : folder;
  for (const fs::path& place : {beside, beside / "..", beside / "../..", fs::path(".")}) {
    const fs::path file = place / input->path;
    if (is_file_of(file, input->sha256)) return qgc_site_of(file);
  }
  return {};
}

std::string no_fence_warning(const PlanRecord& record, const std::string& option) {
  const std::optional<InputFile> input = map_plan_of(record);
  const std::string source =
      input ? " (that of the map, " + input->path + ", was not found)" : std::string();
  return "the exported plan has no fence or rally points, and its home altitude is 0: "
         "uploading it deletes the vehicle's; " +
         option + " keeps those of a QGroundControl plan" + source;
}

}  // namespace fairway
