#include "fairway/run/mission_on_map.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/map/earth_frame.hpp"
#include "fairway/map/frame_from_degrees.hpp"
#include "fairway/map/read_path.hpp"
#include "fairway/map/source_text.hpp"
#include "fairway/map/tangent_plane.hpp"

namespace fairway {
namespace {

constexpr int goal_decimals_deg = 7;  // a centimetre

Vec2 goal_on_map(const Scenario& scenario, const ObstacleMap& map) {
  const MissionRequest& asked = scenario.mission;
  if (!asked.goal_deg) return *asked.goal_m;
  const std::string where = scenario.place_of("mission.goal_deg");
  if (!map.frame.is_on_earth()) {
    throw InputError(where,
                     "mission.goal_deg: this map is not georeferenced, expected mission.goal_m = "
                     "[x, y] in metres");
  }
  const FrameFromDegrees to_metres(map.frame, where);
  const Vec2 goal_m = to_metres.point_m(where, *asked.goal_deg);
  if (map.frame.geo && !(norm(goal_m) <= tangent_plane_limit_m)) {
    throw InputError(where, fmt::format("mission.goal_deg: is more than {} km from the map's "
                                        "reference point, latitude {} longitude {}",
                                        tangent_plane_limit_m / 1000.0, map.frame.geo->latitude_deg,
                                        map.frame.geo->longitude_deg));
  }
  return goal_m;
}

/// In degrees, with the map's extent between its corners; empty where that is ambiguous.
std::string outside_in_degrees(const Scenario& scenario, const ObstacleMap& map) {
  const Grid& g = map.grid;
  const LonLatOf degrees = lon_lat_of(map.frame, scenario.map.file.string());
  const LonLat low = degrees({g.x0_m, g.y0_m});
  const LonLat high = degrees({g.x0_m + g.width_m(), g.y0_m + g.height_m()});
  const auto& asked = *scenario.mission.goal_deg;
  const auto text = [](double deg) { return decimal_text(deg, goal_decimals_deg); };
  return fmt::format(" ({} is outside about latitude {} to {} and longitude {} to {})",
                     lat_lon_text({asked.longitude_deg, asked.latitude_deg}, goal_decimals_deg),
                     text(low.latitude_deg), text(high.latitude_deg), text(low.longitude_deg),
                     text(high.longitude_deg));
}

/// The most common cause of a goal outside the map.
std::string hint(const Scenario& scenario, const ObstacleMap& map) {
  if (!map.frame.geo || !scenario.mission.goal_m) return {};
  return "; this map came in degrees and is planned in metres about its reference point: give "
         "mission.goal_deg = [latitude, longitude]";
}

}  // namespace

const char* place_key(const Scenario& scenario) {
  if (scenario.mission.kind == MissionKind::path) {
    return scenario.mission.loiter.center_m ? "mission.loiter" : "mission.path_file";
  }
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
  for (const EarthState& s : scenario.simulate.states_deg)
    request.also_hold_deg.push_back({s.latitude_deg, s.longitude_deg});
  if (asked.loiter.center_m) {
    const double radius_m = *asked.loiter.radius_m;
    for (const double side : {-radius_m, radius_m}) {
      request.also_hold_m.push_back(*asked.loiter.center_m + Vec2{side, side});
    }
  }
  request.also_hold_path = asked.path_file;
  if (!scenario.file.empty()) {
    request.place_of = [of = std::make_shared<const Scenario>(scenario)](std::string_view key) {
      return of->place_of(key);
    };
  }
  return request;
}

namespace {

/// Straight pieces nowhere farther from the circle than a few ten-thousandths of its radius.
std::vector<Vec2> circle(const LoiterRequest& loiter) {
  constexpr int pieces = 120;
  const double side = loiter.direction == LoiterDirection::left ? 1.0 : -1.0;
  std::vector<Vec2> vertices;
  for (int k = 0; k < pieces; ++k) {
    const Heading way = Heading::from_rad(side * k * two_pi / pieces);
    vertices.push_back(*loiter.center_m + *loiter.radius_m * way.unit());
  }
  return vertices;
}

PathMission path_on_map(const Scenario& scenario, const ObstacleMap& map) {
  const MissionRequest& asked = scenario.mission;
  if (asked.loiter.center_m) {
    return {circle(asked.loiter), true, asked.delta_position_m, asked.delta_heading_rad,
            asked.accept};
  }
  try {
    return {read_path(*asked.path_file, map, asked.closed), asked.closed, asked.delta_position_m,
            asked.delta_heading_rad, asked.accept};
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
      throw InputError(
          scenario.place_of(place_key(scenario)),
          fmt::format("{}: the goal {}{}", place_key(scenario), outside_text(goal_m, map.grid),
                      asked.goal_deg ? outside_in_degrees(scenario, map) : hint(scenario, map)));
    }
    return GoalMission{goal_m, asked.goal_heading_rad, asked.hold, asked.hold_radius_m};
  } catch (const InputError& error) {
    throw WarnedInputError(error.where(), reason_of(error), map.warnings);
  }
}

std::string refusal_words(const Scenario& scenario, const Frame& frame,
                          const MissionRefusal& refusal) {
  if (!scenario.mission.goal_deg || !refusal.words) return refusal.message;
  const LonLatOf degrees = lon_lat_of(frame, scenario.map.file.string());
  return refusal.words([&](Vec2 place_m, int decimals) {
    constexpr int of_a_degree = 5;  // 1e-5 degrees are a metre
    return lat_lon_text(degrees(place_m), decimals + of_a_degree);
  });
}

void throw_refusal(const Scenario& scenario, const Frame& frame, const MissionRefusal& refusal) {
  const char* key = place_key(scenario);
  throw WarnedInputError(scenario.place_of(key),
                         fmt::format("{}: {}", key, refusal_words(scenario, frame, refusal)),
                         refusal.warnings);
}

}  // namespace fairway
