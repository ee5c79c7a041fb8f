// The readers of vector maps, one file each; read_map chooses among them.
#pragma once

#include <string_view>

#include "fairway/map/geodetic_fences.hpp"
#include "fairway/map/json_source.hpp"
#include "fairway/map/mission_items.hpp"
#include "fairway/map/source_text.hpp"

namespace fairway {

/// GeoJSON (geojson.cpp): polygons are obstacles, with "inclusion": true keep-in fences; points
/// with "radius_m" are round. With request.altitude_m, areas whose "height" is not above
/// altitude_m - margin_m are free.
[[nodiscard]] GeodeticFences read_geojson(const SourceText& source, const nlohmann::json& json,
                                          const MapRequest& request);

/// QGroundControl .plan (qgc_plan.cpp): fences, mission items, home.
[[nodiscard]] GeodeticFences read_qgc_plan(const SourceText& source, const nlohmann::json& json);

/// The places a .plan's mission visits, in order.
[[nodiscard]] std::vector<MissionPlace> read_plan_mission(const SourceText& source,
                                                          const nlohmann::json& json);

/// True for an object that QGroundControl would open as a plan.
[[nodiscard]] bool is_qgc_plan(const nlohmann::json& json);

/// ArduPilot fence text (ardupilot_fence.cpp): the return point, then one closed keep-in ring.
[[nodiscard]] GeodeticFences read_ardupilot_fence(const SourceText& source);

/// QGC WPL 110 (qgc_waypoints.cpp): fence items (commands 5000 to 5004), mission items, home.
[[nodiscard]] GeodeticFences read_waypoint_fences(const SourceText& source);

/// The places a QGC WPL 110 mission visits, in order, without home.
[[nodiscard]] std::vector<MissionPlace> read_waypoint_mission(const SourceText& source);

[[nodiscard]] bool is_waypoint_file(std::string_view head);

}  // namespace fairway
