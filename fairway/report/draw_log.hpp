// A flight log with the nearest motion of a vehicle contract: the whole flight, and beside it the
// surroundings of the worst place with the tracking distance to scale.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/report/picture.hpp"

namespace fairway {

struct LogPicture {
  std::string title = {};
  std::vector<Vec2> log_m = {};     ///< at least two places
  std::vector<Vec2> motion_m = {};  ///< one for each of the log, up to where there is a motion
  std::size_t worst_sample = 0;     ///< of the log
  std::string worst_name = {};      ///< in the legend
  double tracking_m = 1.0;          ///< above 0
  double map_pt = 300.0;            ///< side of each of the two maps
  double pixels_per_pt = 2.0;
};

/// Throws PreconditionViolation when there is no flight or the worst sample is none of its.
[[nodiscard]] Picture draw_log(const LogPicture& picture);

}  // namespace fairway
