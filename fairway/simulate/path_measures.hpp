// How near flights keep to a path, and how parallel to it (paper 1, Fig. 7, by the measures of
// Eq. 5).
//
// A flight is sampled in even time steps, each the time for `step_m` at the plan's speed: reported
// times are accurate to one step, and a worst distance to half of `step_m` (twice that in wind as
// fast as the vehicle).
#pragma once

#include "fairway/simulate/flight.hpp"
#include "fairway/simulate/flight_measures.hpp"
#include "fairway/simulate/value_spread.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway {

/// Over the time of many flights, from when each has joined.
struct PathSpreads {
  SpreadCounter distance_m;
  SpreadCounter heading_rad;  ///< sizes of the difference
};

class PathMeter {
 public:
  /// Throws PreconditionViolation unless speed and step are positive.
  PathMeter(const PathMission& path, double speed_mps, double step_m);

  /// Of a recorded flight. Its steps are added to `spreads` unless that is null. Threads may share
  /// a meter, not the spreads.
  [[nodiscard]] PathFollowing measure(const Flight& flight, PathSpreads* spreads = nullptr) const;

  const PathLocator& locator() const { return locator_; }

 private:
  PathLocator locator_;
  double speed_mps_;
  double step_s_;
};

}  // namespace fairway
