#include "fairway/run/mission_on_map.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/map/read_path.hpp"
#include "fairway/map/source_text.hpp"
#include "fairway/map/tangent_plane.hpp"

namespace fairway {
namespace {

Vec2 goal_on_map(const Scenario& scenario, const ObstacleMap& map) {
  const MissionRequest& asked = scenario.mission;
  if (!asked.goal_deg) return *asked.goal_m;
  if (!map.frame.geo) {
    throw InputError(
        scenario.place_of("mission.goal_deg"),
        "mission.goal_deg: this map is not in degrees, expected mission.goal_m = [x, y] "
        "in metres");
  }
  const TangentPlane plane({map.frame.geo->latitude_deg, map.frame.geo->longitude_deg});
  const Vec2 goal_m = plane.to_plane_m(*asked.goal_deg);
  if (!std::isfinite(goal_m.x) || !std::isfinite(goal_m.y) ||
      norm(goal_m) > tangent_plane_limit_m) {
    throw InputError(scenario.place_of("mission.goal_deg"),
                     fmt::format("mission.goal_deg: is more than {} km from the map's reference "
                                 "point, latitude {} longitude {}",
                                 tangent_plane_limit_m / 1000.0, map.frame.geo->latitude_deg,
                                 map.frame.geo->longitude_deg));
  }
  return goal_m;
}

/// What most often stands behind a goal outside the map.
std::string hint(const Scenario& scenario, const ObstacleMap& map) {
  if (!map.frame.geo || !scenario.mission.goal_m) return {};
  return "; this map came in degrees and is planned in metres about its reference point: give "
         "mission.goal_deg = [latitude, longitude]";
}

}  // namespace

const char* place_key(const Scenario& scenario) {
  if (scenario.mission.kind == MissionKind::path) return "mission.path_file";
  return scenario.mission.goal_deg ? "mission.goal_deg" : "mission.goal_m";
}

MapRequest map_request(const Scenario& scenario) {
  MapRequest request = scenario.map;
  // A goal disc is beta wide, a turn on the spot of a path 2; then the buffer. Of the two cells one
  // may stick out beyond the world, and the paper's metric rounds the buffer up by less than one.
  const double turns = scenario.plan.alpha + std::max(scenario.plan.beta, 2.0);
  request.least_world_margin_m = turns * scenario.vehicle.turn_radius_m + 2.0 * request.cell_m;
  const MissionRequest& asked = scenario.mission;
  if (asked.goal_m) request.also_hold_m.push_back(*asked.goal_m);
  if (asked.goal_deg) request.also_hold_deg.push_back(*asked.goal_deg);
  for (const State& s : scenario.simulate.states) request.also_hold_m.push_back(s.position_m);
  request.also_hold_path = asked.path_file;
  if (!scenario.file.empty()) {
    request.place_of = [of = std::make_shared<const Scenario>(scenario)](std::string_view key) {
      return of->place_of(key);
    };
  }
  return request;
}

namespace {

PathMission path_on_map(const Scenario& scenario, const ObstacleMap& map) {
  const MissionRequest& asked = scenario.mission;
  try {
    return {read_path(*asked.path_file, map, asked.closed), asked.closed, asked.delta_position_m,
            asked.delta_heading_rad};
  } catch (const InputError& error) {
    throw InputError(error.where(), fmt::format("{} (mission.path_file of {})", reason_of(error),
                                                scenario.place_of("mission.path_file")));
  }
}

}  // namespace

Mission mission_on_map(const Scenario& scenario, const ObstacleMap& map) {
  const MissionRequest& asked = scenario.mission;
  try {
    if (asked.kind == MissionKind::path) return path_on_map(scenario, map);
    const Vec2 goal_m = goal_on_map(scenario, map);
    if (!is_within(map.grid, goal_m)) {
      throw InputError(scenario.place_of(place_key(scenario)),
                       fmt::format("{}: the goal {}{}", place_key(scenario),
                                   outside_text(goal_m, map.grid), hint(scenario, map)));
    }
    return GoalMission{goal_m, asked.goal_heading_rad};
  } catch (const InputError& error) {
    throw WarnedInputError(error.where(), reason_of(error), map.warnings);
  }
}

void throw_refusal(const Scenario& scenario, const MissionRefusal& refusal) {
  const char* key = place_key(scenario);
  throw WarnedInputError(scenario.place_of(key), fmt::format("{}: {}", key, refusal.message),
                         refusal.warnings);
}

}  // namespace fairway
