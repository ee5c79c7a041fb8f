#include "fairway/vehicle/mission_json.hpp"

#include "fairway/base/error.hpp"
#include "fairway/base/strict_json.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr const char* touch = "touch";

Vec2 point(const json& value, const std::string& where) {
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
    throw InputError(where, "expected [x, y], found " + shown(value));
  }
  return {value[0].get<double>(), value[1].get<double>()};
}

GoalMission goal_mission(const json& value, const std::string& where) {
  GoalMission goal{point(member(value, "goal_m", where), where + ".goal_m"), {}};
  if (value.contains("goal_heading_rad") && !value["goal_heading_rad"].is_null()) {
    goal.goal_heading_rad = finite_number(value, "goal_heading_rad", where);
  }
  if (value.contains("hold")) {
    if (!value["hold"].is_boolean()) throw InputError(where + ".hold", "expected true or false");
    goal.hold = value["hold"].get<bool>();
  }
  if (value.contains("hold_radius_m")) {
    goal.hold_radius_m = finite_number(value, "hold_radius_m", where);
  }
  return goal;
}

PathMission path_mission(const json& value, const std::string& where) {
  PathMission path;
  const json& vertices = member(value, "vertices_m", where);
  if (!vertices.is_array()) throw InputError(where + ".vertices_m", "expected [[x, y], ...]");
  for (const json& vertex : vertices) {
    path.vertices_m.push_back(point(vertex, where + ".vertices_m"));
  }
  const json& closed = member(value, "closed", where);
  if (!closed.is_boolean()) throw InputError(where + ".closed", "expected true or false");
  path.closed = closed.get<bool>();
  path.delta_position_m = finite_number(value, "delta_position_m", where);
  path.delta_heading_rad = finite_number(value, "delta_heading_rad", where);
  if (value.contains("accept")) {
    if (value["accept"] != touch) {
      throw InputError(where + ".accept", "expected \"touch\", found " + shown(value["accept"]));
    }
    path.accept = PathAccept::touch;
  }
  return path;
}

}  // namespace

json json_of(const Mission& mission) {
  if (const auto* goal = std::get_if<GoalMission>(&mission)) {
    json value = {
        {"kind", "goal"},
        {"goal_m", {goal->goal_m.x, goal->goal_m.y}},
        {"goal_heading_rad", goal->goal_heading_rad ? json(*goal->goal_heading_rad) : json()}};
    if (goal->hold) value["hold"] = true;
    if (goal->hold_radius_m) value["hold_radius_m"] = *goal->hold_radius_m;
    return value;
  }
  const auto& path = std::get<PathMission>(mission);
  json vertices = json::array();
  for (const Vec2 v : path.vertices_m) vertices.push_back({v.x, v.y});
  json record = {{"kind", "path"},
                 {"vertices_m", std::move(vertices)},
                 {"closed", path.closed},
                 {"delta_position_m", path.delta_position_m},
                 {"delta_heading_rad", path.delta_heading_rad}};
  if (path.accept == PathAccept::touch) record["accept"] = touch;
  return record;
}

Mission mission_of(const json& value, const std::string& where) {
  const std::string kind = text_member(value, "kind", where);
  if (kind == "goal") return goal_mission(value, where);
  if (kind == "path") return path_mission(value, where);
  throw InputError(where + ".kind", "is \"" + kind + "\", expected \"goal\" or \"path\"");
}

}  // namespace fairway
