// Steering to poses or along waypoints, leg by leg; on request with its track and its picture.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fairway/report/picture.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/steer/pose_csv.hpp"

namespace fairway {

enum class SteeringLaw { shortest, clf };

/// A state of a leg, and what the law makes of it.
struct TrackPoint {
  double driven_m = 0.0;  ///< since the leg began
  State state;
  double curvature_per_m = 0.0;  ///< held from here on; at the end, as before
  double value = 0.0;            ///< V: what is left in radii (shortest), or Eq. 20 (clf)
  double attract = 0.0;          ///< clf: V_A, Eq. 9
  double repel = 0.0;            ///< clf: V_R, Eq. 17; not a number while nothing repels
};

struct SteeredLeg {
  State from;
  State goal;
  double length_m = 0.0;
  std::string word;
  bool converged = false;
  State end;
  std::vector<TrackPoint> track;        ///< when asked for
  std::vector<FlightSegment> segments;  ///< when a track is asked for
};

enum class LegTrack { none, all };

/// Each pair by itself, on all threads.
[[nodiscard]] std::vector<SteeredLeg> steer_pairs(const PosePairs& pairs, double turn_radius_m,
                                                  SteeringLaw law, LegTrack track);

/// From each waypoint to the next; under the law clf a leg begins where the one before ended, and
/// a leg that does not converge is the last.
[[nodiscard]] std::vector<SteeredLeg> steer_waypoints(const PosePairs& legs, double turn_radius_m,
                                                      SteeringLaw law, LegTrack track);

/// leg,driven_m,x_m,y_m,heading_rad,curvature_per_m,value: legs from 0, driven since the first.
[[nodiscard]] std::string track_csv(std::span<const SteeredLeg> legs);

[[nodiscard]] Picture steering_picture(std::span<const SteeredLeg> legs, double turn_radius_m,
                                       SteeringLaw law);

}  // namespace fairway
