// The measures of one flight, in addition to its outcome.
#pragma once

#include <limits>

#include "fairway/simulate/flight.hpp"

namespace fairway {

/// How a flight keeps to the path of its mission once it is on it, over the ground (in wind the
/// heading is the course). It is on the path while both deltas hold (paper 1, Eq. 5), and has
/// joined it when that is so for the first time. Measured from there to the end of the flight; on
/// an open path to where its end is passed.
struct PathFollowing {
  double joined_s = std::numeric_limits<double>::infinity();  ///< since the start; +inf: never
  double measured_s = 0.0;                                    ///< all below is 0 when it is
  double on_path_share = 0.0;
  double distance_mean_m = 0.0;  ///< from the nearest point of the path
  double distance_worst_m = 0.0;
  double heading_mean_rad = 0.0;  ///< size of the difference from the path's direction there
  double heading_worst_rad = 0.0;
  double laps = 0.0;  ///< progress along the path by its length; backwards counts against it
  friend bool operator==(const PathFollowing&, const PathFollowing&) = default;
};

struct FlightMeasures {
  Turning turning;
  Onward onward;            ///< After::none unless the flight was followed and reaches
  PathFollowing following;  ///< never joined unless the flight was followed
  friend bool operator==(const FlightMeasures&, const FlightMeasures&) = default;
};

}  // namespace fairway
