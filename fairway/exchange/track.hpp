// A recorded flight as points along it, with its last leg when it has one.
//
// Properties that always hold of a track:
//   1. Both ends of every piece are in it, and points between them no farther apart than the step;
//      where pieces join there is one point, with the curvature of the piece that begins.
//   2. Times ascend; the last point is the flight's end.
// and of a thinned one: it begins and ends where the flight does, and no point of the flight is
// farther from it than the tolerance, nor any of its points off the flight.
#pragma once

#include <span>
#include <vector>

#include "fairway/simulate/flight.hpp"

namespace fairway {

struct FlightPoint {
  double time_s = 0.0;
  State state;
  double curvature_per_m = 0.0;  ///< positive to the left
};

/// `step_m` and `speed_mps` > 0, else PreconditionViolation. A flight without pieces is its start.
[[nodiscard]] std::vector<FlightPoint> track_of(const Flight& flight, double speed_mps,
                                                double step_m);

/// Few points to fly through one after the other in straight lines (Douglas and Peucker 1973 on the
/// track, finer than the tolerance). Throws PreconditionViolation unless `tolerance_m` > 0.
[[nodiscard]] std::vector<FlightPoint> thinned_track(const Flight& flight, double speed_mps,
                                                     double tolerance_m);

}  // namespace fairway
