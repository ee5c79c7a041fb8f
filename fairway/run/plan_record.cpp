#include "fairway/run/plan_record.hpp"

#include <algorithm>
#include <utility>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/map/tangent_plane.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/version.hpp"

namespace fairway {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

json mission_json(const Mission& mission) {
  if (const auto* goal = std::get_if<GoalMission>(&mission)) {
    json heading;
    if (goal->goal_heading_rad) heading = *goal->goal_heading_rad;
    return {{"kind", "goal"},
            {"goal_m", {goal->goal_m.x, goal->goal_m.y}},
            {"goal_heading_rad", heading}};
  }
  const auto& path = std::get<PathMission>(mission);
  json vertices = json::array();
  for (const Vec2 v : path.vertices_m) vertices.push_back({v.x, v.y});
  return {{"kind", "path"},
          {"vertices_m", vertices},
          {"closed", path.closed},
          {"delta_position_m", path.delta_position_m},
          {"delta_heading_rad", path.delta_heading_rad}};
}

json frame_json(const ObstacleMap& map) {
  json frame = {{"world_from_grid",
                 {{"x_m", map.world_from_grid.x_m},
                  {"y_m", map.world_from_grid.y_m},
                  {"yaw_rad", map.world_from_grid.yaw_rad}}},
                {"georeference", nullptr},
                {"projected_crs", nullptr}};
  if (map.geo) {
    frame["georeference"] = {{"latitude_deg", map.geo->latitude_deg},
                             {"longitude_deg", map.geo->longitude_deg},
                             {"worst_error_m", map.geo->worst_error_m}};
  }
  if (map.projected_crs) frame["projected_crs"] = *map.projected_crs;
  return frame;
}

std::string record_text(const ObstacleMap& map, const Mission& mission, const json& options,
                        const json& inputs) {
  const json record = {{"program", program_version},
                       {"mission", mission_json(mission)},
                       {"options", options},
                       {"inputs", inputs},
                       {"frame", frame_json(map)}};
  return record.dump(-1, ' ', true, json::error_handler_t::replace);
}

/// Relative to the scenario's folder, so that a record does not depend on where a checkout lies.
std::string path_in_record(const fs::path& path, const Scenario& scenario) {
  const fs::path folder = fs::absolute(scenario.file).lexically_normal().parent_path();
  return fs::absolute(path).lexically_normal().lexically_relative(folder).generic_string();
}

}  // namespace

json inputs_json(const Scenario& scenario, const ObstacleMap& map) {
  json inputs = json::array();
  inputs.push_back(
      {{"path", path_in_record(scenario.file, scenario)}, {"sha256", scenario.sha256}});
  for (const InputFile& input : map.inputs) {
    inputs.push_back({{"path", path_in_record(input.path, scenario)}, {"sha256", input.sha256}});
  }
  if (const auto& path = scenario.mission.path_file) {
    inputs.push_back({{"path", path_in_record(*path, scenario)}, {"sha256", sha256_file(*path)}});
  }
  return inputs;
}

std::string plan_record(const Scenario& scenario, const ObstacleMap& map, const Mission& mission) {
  json options = {{"map", effective_values(scenario, "map")},
                  {"plan", effective_values(scenario, "plan")}};
  options["map"].erase("file");  // it stands among the inputs
  return record_text(map, mission, options, inputs_json(scenario, map));
}

std::string plan_record(const ObstacleMap& map, const Mission& mission,
                        const FieldOptions& options) {
  Scenario asked;
  asked.plan = options;
  json inputs = json::array();
  for (const InputFile& input : map.inputs) {
    inputs.push_back({{"path", input.path}, {"sha256", input.sha256}});
  }
  return record_text(map, mission, {{"plan", effective_values(asked, "plan")}}, inputs);
}

Plan plan_of_field(Field&& field, const Vehicle& vehicle, std::string record_json) {
  return {field.grid,
          vehicle,
          std::move(field.heading_rad),
          std::move(field.region),
          std::move(field.cost_m),
          std::move(record_json)};
}

std::optional<GeoReference> georeference_of(const Plan& plan, const std::string& where) {
  const json record = parse_strict_json(plan.record_json, where);
  const std::string place = where + ": fairway.frame.georeference";
  if (!record.contains("frame") || !record["frame"].is_object() ||
      !record["frame"].contains("georeference") || record["frame"]["georeference"].is_null()) {
    return {};
  }
  const json& geo = record["frame"]["georeference"];
  return GeoReference{finite_number(geo, "latitude_deg", place),
                      finite_number(geo, "longitude_deg", place),
                      finite_number(geo, "worst_error_m", place)};
}

std::optional<State> goal_pose_of(const Plan& plan, const std::string& where) {
  const json record = parse_strict_json(plan.record_json, where);
  const std::string place = where + ": fairway.mission";
  if (!record.contains("mission") || !record["mission"].is_object()) return {};
  const json& mission = record["mission"];
  if (!mission.contains("goal_heading_rad") || mission["goal_heading_rad"].is_null()) return {};
  const double heading_rad = finite_number(mission, "goal_heading_rad", place);
  const json& goal = member(mission, "goal_m", place);
  const auto is_in = [&](std::size_t axis, double low, double size) {
    return goal[axis].is_number() && goal[axis].get<double>() >= low &&
           goal[axis].get<double>() <= low + size;
  };
  const Grid& grid = plan.grid;
  if (!goal.is_array() || goal.size() != 2 || !is_in(0, grid.x0_m, grid.width_m()) ||
      !is_in(1, grid.y0_m, grid.height_m())) {
    throw InputError(place + ".goal_m", "expected [x, y] on the plan's grid, found " + shown(goal));
  }
  return State{{goal[0].get<double>(), goal[1].get<double>()}, Heading::from_rad(heading_rad)};
}

LonLatOf lon_lat_of(const std::optional<GeoReference>& georeference) {
  if (!georeference) return {};
  const TangentPlane plane({georeference->latitude_deg, georeference->longitude_deg});
  return [plane](Vec2 position_m) {
    const GeodeticPoint point = plane.from_plane(position_m);
    return LonLat{point.longitude_deg, point.latitude_deg};
  };
}

}  // namespace fairway
