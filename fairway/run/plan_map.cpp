#include "fairway/run/plan_map.hpp"

#include <utility>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/run/plan_record.hpp"

namespace fairway {
namespace {

using nlohmann::json;

Vec2 point(const json& value, const std::string& where) {
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
    throw InputError(where, "expected [x, y], found " + shown(value));
  }
  return {value[0].get<double>(), value[1].get<double>()};
}

GoalMission goal_mission(const json& mission, const std::string& place) {
  GoalMission goal{point(member(mission, "goal_m", place), place + ".goal_m"), {}};
  if (mission.contains("goal_heading_rad") && !mission["goal_heading_rad"].is_null()) {
    goal.goal_heading_rad = finite_number(mission, "goal_heading_rad", place);
  }
  return goal;
}

PathMission path_mission(const json& mission, const std::string& place) {
  PathMission path;
  const json& vertices = member(mission, "vertices_m", place);
  if (!vertices.is_array()) throw InputError(place + ".vertices_m", "expected [[x, y], ...]");
  for (const json& vertex : vertices) {
    path.vertices_m.push_back(point(vertex, place + ".vertices_m"));
  }
  const json& closed = member(mission, "closed", place);
  if (!closed.is_boolean()) throw InputError(place + ".closed", "expected true or false");
  path.closed = closed.get<bool>();
  path.delta_position_m = finite_number(mission, "delta_position_m", place);
  path.delta_heading_rad = finite_number(mission, "delta_heading_rad", place);
  return path;
}

}  // namespace

std::variant<Plan, MissionRefusal> plan_map(const ObstacleMap& map, const Vehicle& vehicle,
                                            const Mission& mission, const FieldOptions& options) {
  FieldOrRefusal answer = compute_field(map, vehicle, mission, options);
  if (auto* refusal = std::get_if<MissionRefusal>(&answer)) return std::move(*refusal);
  return plan_of_field(std::move(std::get<Field>(answer)), vehicle,
                       plan_record(map, mission, options));
}

std::optional<Mission> mission_of(const Plan& plan, const std::string& where) {
  const json record = parse_strict_json(plan.record_json, where);
  if (!record.contains("mission")) return {};
  const std::string place = where + ": fairway.mission";
  const json& mission = record["mission"];
  const std::string kind = text_member(mission, "kind", place);
  if (kind == "goal") return goal_mission(mission, place);
  if (kind == "path") return path_mission(mission, place);
  throw InputError(place + ".kind", "is \"" + kind + "\", expected \"goal\" or \"path\"");
}

}  // namespace fairway
