// Numbers for what paper 1's text says about its figures.
#pragma once

#include <vector>

#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway::reproduce {

/// How smooth a heading is over time, after the first turn: from any start the vehicle first turns
/// to the field, which says nothing about the field.
struct HeadingMeasures {
  double turning_rad = 0.0;         ///< all turning added up, left and right: total variation
  int reversals = 0;                ///< left turns followed by right turns, or the other way round
  double rms_rate_radps = 0.0;      ///< of the heading's mean rate over windows of `window_s`
  double largest_rate_radps = 0.0;  ///< the largest of them
};

/// `window_s` > 0. A flight shorter than its first turn and one window has rates of 0.
[[nodiscard]] HeadingMeasures heading_measures(const Flight& flight, double speed_mps,
                                               double window_s);

/// How far a flight strays from a path.
struct PathMeasures {
  double mean_m = 0.0;  ///< over the flight's length
  double max_m = 0.0;
  std::vector<double> corner_m;  ///< per corner of the path: the most within `corner_reach_m` of it
  double mean_of_straights_m = 0.0;  ///< over the parts farther from every corner
};

/// Corners are the vertices, for open paths without the ends. `step_m` > 0: how finely a flight is
/// sampled.
[[nodiscard]] PathMeasures path_measures(const Flight& flight, double speed_mps,
                                         const PathMission& path, double corner_reach_m,
                                         double step_m);

}  // namespace fairway::reproduce
