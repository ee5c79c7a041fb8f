#include "fairway/exchange/qgc_mission.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/exchange/track.hpp"

namespace fairway {
namespace {

// MAVLink's names of commands and frames.
constexpr int command_waypoint = 16;
constexpr int command_change_speed = 178;
constexpr int frame_absolute = 0;
constexpr int frame_mission = 2;
constexpr int frame_above_home = 3;

std::vector<LonLat> waypoints_of(const Flight& flight, double speed_mps, const LonLatOf& lon_lat_of,
                                 const QgcMissionOptions& options) {
  require(static_cast<bool>(lon_lat_of), "a mission has a place on Earth");
  require(std::isfinite(options.altitude_m) && options.altitude_m >= 0.0, "the altitude is >= 0");
  require(std::isfinite(options.tolerance_m), "the tolerance is finite");
  require(std::isfinite(options.site.home_altitude_m), "the home altitude is finite");
  std::vector<LonLat> waypoints;
  for (const FlightPoint& point : thinned_track(flight, speed_mps, options.tolerance_m)) {
    waypoints.push_back(lon_lat_of(point.state.position_m));
  }
  return waypoints;
}

std::string plan_item(std::size_t number, double altitude_m, const LonLat& place) {
  return fmt::format(R"(            {{
                "AMSLAltAboveTerrain": null,
                "Altitude": {0},
                "AltitudeMode": 1,
                "autoContinue": true,
                "command": {1},
                "doJumpId": {2},
                "frame": {3},
                "params": [0, 0, 0, null, {4:.9f}, {5:.9f}, {0}],
                "type": "SimpleItem"
            }})",
                     altitude_m, command_waypoint, number, frame_above_home, place.latitude_deg,
                     place.longitude_deg);
}

}  // namespace

std::vector<std::string> mission_warnings(std::span<const Flight> flights) {
  std::vector<std::string> warnings;
  const auto after = [](double time_s) {
    return std::isfinite(time_s) ? fmt::format(" after {:.2f} s", time_s) : std::string();
  };
  for (const Flight& flight : flights) {
    const FlightResult& r = flight.result;
    const std::string onward = after(flight.onward.time_s);
    switch (r.outcome) {
      case Outcome::reach:
        if (flight.onward.after == After::collide) {
          warnings.push_back("the flight reaches the path and collides" + onward +
                             ", and the mission leads there too.");
        } else if (flight.onward.after == After::leave) {
          warnings.push_back("the flight reaches the path and leaves the map" + onward +
                             ", and the mission leads there too.");
        }
        break;
      case Outcome::collide:
        warnings.push_back("the flight collides" + after(r.time_s) +
                           ", and the mission leads there too.");
        break;
      case Outcome::leave:
        warnings.push_back("the flight leaves the map" + after(r.time_s) +
                           ", and the mission leads there too.");
        break;
      case Outcome::hold:
      case Outcome::trapped:
        warnings.push_back(
            "the flight never reaches the goal; the mission, which ends, does not either.");
        break;
    }
  }
  return warnings;
}

std::string qgc_plan_text(const Flight& flight, double speed_mps, const LonLatOf& lon_lat_of,
                          const QgcMissionOptions& options) {
  const std::vector<LonLat> waypoints = waypoints_of(flight, speed_mps, lon_lat_of, options);
  std::string items = fmt::format(R"(            {{
                "autoContinue": true,
                "command": {},
                "doJumpId": 1,
                "frame": {},
                "params": [0, {}, -1, 0, 0, 0, 0],
                "type": "SimpleItem"
            }})",
                                  command_change_speed, frame_mission, speed_mps);
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    items += ",\n" + plan_item(i + 2, options.altitude_m, waypoints[i]);
  }
  return fmt::format(R"({{
    "fileType": "Plan",
    "geoFence": {4},
    "groundStation": "QGroundControl",
    "mission": {{
        "cruiseSpeed": {0},
        "firmwareType": 12,
        "globalPlanAltitudeMode": 1,
        "hoverSpeed": {0},
        "items": [
{1}
        ],
        "plannedHomePosition": [{2:.9f}, {3:.9f}, {6}],
        "vehicleType": 1,
        "version": 2
    }},
    "rallyPoints": {5},
    "version": 1
}}
)",
                     speed_mps, items, waypoints.front().latitude_deg,
                     waypoints.front().longitude_deg, options.site.fence_json,
                     options.site.rally_points_json, options.site.home_altitude_m);
}

std::string qgc_waypoints_text(const Flight& flight, double speed_mps, const LonLatOf& lon_lat_of,
                               const QgcMissionOptions& options) {
  const std::vector<LonLat> waypoints = waypoints_of(flight, speed_mps, lon_lat_of, options);
  // index, current, frame, command, four parameters, latitude, longitude, altitude, autocontinue
  const auto line = [](std::size_t index, int frame, int command, double parameter_2,
                       double parameter_3, const LonLat& place, double altitude_m) {
    return fmt::format("{}\t{}\t{}\t{}\t0\t{}\t{}\t0\t{:.9f}\t{:.9f}\t{}\t1\n", index,
                       index == 0 ? 1 : 0, frame, command, parameter_2, parameter_3,
                       place.latitude_deg, place.longitude_deg, altitude_m);
  };
  std::string text = "QGC WPL 110\n";
  text += line(0, frame_absolute, command_waypoint, 0.0, 0.0, waypoints.front(), 0.0);
  text += line(1, frame_mission, command_change_speed, speed_mps, -1.0, {}, 0.0);
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    text +=
        line(i + 2, frame_above_home, command_waypoint, 0.0, 0.0, waypoints[i], options.altitude_m);
  }
  return text;
}

bool is_qgc_mission_name(const std::filesystem::path& file) {
  const std::string kind = file.extension().string();
  return kind == ".plan" || kind == ".waypoints" || kind == ".txt";
}

std::string qgc_mission_text(const std::filesystem::path& file, const Flight& flight,
                             double speed_mps, const LonLatOf& lon_lat_of,
                             const QgcMissionOptions& options) {
  const auto text = file.extension() == ".plan" ? qgc_plan_text : qgc_waypoints_text;
  return text(flight, speed_mps, lon_lat_of, options);
}

}  // namespace fairway
