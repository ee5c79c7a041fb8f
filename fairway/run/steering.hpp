// Steering to poses or along waypoints, leg by leg; on request with its track and its picture.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fairway/report/picture.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/steer/pose_csv.hpp"
#include "fairway/steer/steering_flight.hpp"

namespace fairway {

enum class SteeringLaw { shortest, clf };

/// How to steer. The law shortest gives the shortest path itself unless an option needs a flight in
/// steps: a step, a tolerance, a moving goal, noise.
struct SteeringRequest {
  SteeringLaw law = SteeringLaw::shortest;
  ClfOptions clf;
  std::optional<double> step_m;       ///< of a flight; else a hundredth of the radius
  std::optional<double> tolerance_m;  ///< in place, over the radius in heading; else a fiftieth
  double goal_speed = 0.0;            ///< along its heading, of the vehicle's speed, [0, 1)
  double noise_m = 0.0;    ///< standard deviation of x and y after each step, over r of the heading
  std::uint64_t seed = 1;  ///< of the noise; each pair has draws of its own

  bool is_flown() const {
    return law == SteeringLaw::clf || step_m || tolerance_m || goal_speed > 0.0 || noise_m > 0.0;
  }
  SteeringOptions options(const State& from, const State& goal, double turn_radius_m) const;
};

/// A state of a leg, with what the law computes there.
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
  State goal;  ///< where it is when the leg ends
  double length_m = 0.0;
  std::string word;
  bool converged = false;
  State end;
  std::vector<TrackPoint> track;        ///< when asked for
  std::vector<FlightSegment> segments;  ///< when a track is asked for
};

enum class LegTrack { none, all };

/// Each pair by itself, on all threads. Throws PreconditionViolation when the tolerance does not
/// cover the step.
[[nodiscard]] std::vector<SteeredLeg> steer_pairs(const PosePairs& pairs, double turn_radius_m,
                                                  const SteeringRequest& request, LegTrack track);

/// From each waypoint to the next; under the law clf a leg begins where the one before ended, and
/// a leg that does not converge is the last. Of the request neither noise nor goal_speed; the
/// law shortest gives shortest paths.
[[nodiscard]] std::vector<SteeredLeg> steer_waypoints(const PosePairs& legs, double turn_radius_m,
                                                      const SteeringRequest& request,
                                                      LegTrack track);

/// leg,driven_m,x_m,y_m,heading_rad,curvature_per_m,value: legs from 0, driven since the first.
[[nodiscard]] std::string track_csv(std::span<const SteeredLeg> legs);

[[nodiscard]] Picture steering_picture(std::span<const SteeredLeg> legs, double turn_radius_m,
                                       const SteeringRequest& request);

}  // namespace fairway
