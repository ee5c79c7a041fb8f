// Which MAVLink mission commands take the vehicle to a place.
#pragma once

#include <cmath>
#include <string>

#include "fairway/map/read_map.hpp"

namespace fairway {

struct MissionPlace {
  std::string where;  ///< "FILE:LINE" or a path of keys
  GeodeticPoint point;
};

/// Waypoint, loiter (unlimited, turns, time, to altitude), land, take off, spline waypoint, VTOL
/// take off and land. Jumps, camera and servo commands and the like have no position.
constexpr bool visits_a_place(int command) {
  return (command >= 16 && command <= 19) || command == 21 || command == 22 || command == 31 ||
         command == 82 || command == 84 || command == 85;
}

/// Frames whose coordinates are degrees of latitude and longitude (MAV_FRAME_GLOBAL...).
constexpr bool is_global_frame(int frame) {
  return frame == 0 || frame == 3 || frame == 5 || frame == 6 || frame == 10 || frame == 11;
}

/// Latitude and longitude 0, or NaN, stand for "where the vehicle is".
inline bool is_current_place(double latitude_deg, double longitude_deg) {
  return (latitude_deg == 0.0 && longitude_deg == 0.0) || std::isnan(latitude_deg) ||
         std::isnan(longitude_deg);
}

}  // namespace fairway
