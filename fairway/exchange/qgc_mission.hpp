// A flight as a mission for autopilots: QGroundControl's .plan, or QGC WPL 110, which Mission
// Planner, MAVProxy and QGroundControl read.
//
// The mission is a line through waypoints: the points of the thinned track (track.hpp), no farther
// from the flight than the tolerance. An autopilot has its own guidance between them: what is
// proved about the plan is not proved about such a mission.
// Properties that always hold:
//   1. The first waypoint is where the flight starts, the last where it ends, its last leg
//      included.
//   2. Heights are above the home position, which is the start, on the ground. A .plan's fence and
//      rally points are those of `site`: none, unless they are given.
//   3. map/ reads both files back to the same points, within 1e-9 degrees (0.1 mm).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fairway/base/frame.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// What a .plan holds in addition to the mission, as JSON: uploading it replaces all three on the
/// vehicle.
struct QgcSite {
  std::string fence_json = R"({"circles": [], "polygons": [], "version": 2})";
  std::string rally_points_json = R"({"points": [], "version": 2})";
  double home_altitude_m = 0.0;  ///< above sea level; finite
};

struct QgcMissionOptions {
  double altitude_m = 50.0;  ///< above home, >= 0
  double tolerance_m = 1.0;  ///< > 0
  QgcSite site = {};         ///< .plan alone: a waypoint file has neither fence nor rally points
};

/// A warning for each flight that does not reach, or that collides or leaves after reaching,
/// because its mission leads there too.
[[nodiscard]] std::vector<std::string> mission_warnings(std::span<const Flight> flights);

/// QGroundControl's .plan, version 1. Throws PreconditionViolation when an option is out of range
/// or `lon_lat_of` is empty.
[[nodiscard]] std::string qgc_plan_text(const Flight& flight, double speed_mps,
                                        const LonLatOf& lon_lat_of,
                                        const QgcMissionOptions& options);

/// The same as QGC WPL 110.
[[nodiscard]] std::string qgc_waypoints_text(const Flight& flight, double speed_mps,
                                             const LonLatOf& lon_lat_of,
                                             const QgcMissionOptions& options);

/// Whether a mission's file may have that name: it ends in .plan, .waypoints or .txt.
[[nodiscard]] bool is_qgc_mission_name(const std::filesystem::path& file);

/// Either format, according to the file's name.
[[nodiscard]] std::string qgc_mission_text(const std::filesystem::path& file, const Flight& flight,
                                           double speed_mps, const LonLatOf& lon_lat_of,
                                           const QgcMissionOptions& options);

}  // namespace fairway
