// Following waypoints with headings one by one, under either steering law.
//
// A waypoint is done when the vehicle is within the tolerance `reached`, or when it has just
// crossed the line across the waypoint within `passed`: near enough to go on rather than to drive a
// loop. Then the next one is steered to, by a fresh law. Properties that always hold:
//   1. Latched: waypoints are done in order, each once, and stay done whatever noise, wind or a
//      waypoint's own motion do afterwards.
//   2. A step uses no heap and depends only on the current state and waypoints, the latch and the
//      law's own memory: waypoints that are not done may move, and the vehicle may be pushed.
// With `passed`, ShortestLaw has to know it, so as not to begin the loop before the waypoint is
// passed: shortest_waypoint_law().
// Undisturbed, under ShortestLaw, each leg is longer than the shortest path from where it begins by
// less than a twentieth of the radius (observed, with the steps of steering_options()).
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fairway/steer/steering_flight.hpp"

namespace fairway {

struct WaypointOptions {
  PoseTolerance reached;
  PoseTolerance passed = {};  ///< nothing: a waypoint has to be reached
};

/// `Law`: ClfLaw or ShortestLaw.
template <typename Law>
class WaypointLaw {
 public:
  /// `fresh` is the law's initial state for every waypoint.
  WaypointLaw(const Law& fresh, const WaypointOptions& options)
      : fresh_(fresh), law_(fresh), options_(options) {}

  /// Skips waypoints that are done, then returns the curvature (1/m, left positive) to hold for the
  /// next `step_m` towards `waypoints[next()]`; 0 when all are done.
  [[nodiscard]] double curvature_per_m(const State& state, std::span<const State> waypoints,
                                       double turn_radius_m, double step_m) {
    while (next_ < waypoints.size() && is_done(state, waypoints[next_])) {
      ++next_;
      behind_m_ = 1.0;
      law_ = fresh_;
    }
    if (next_ >= waypoints.size()) return 0.0;
    return law_.curvature_per_m(state, waypoints[next_], turn_radius_m, step_m);
  }

  /// The waypoint steered to, as of the last call; the number of waypoints when all are done.
  std::size_t next() const { return next_; }
  const Law& law() const { return law_; }
  const WaypointOptions& options() const { return options_; }

 private:
  bool is_done(const State& state, const State& waypoint) {
    const double along_m = dot(state.position_m - waypoint.position_m, waypoint.heading.unit());
    const bool crossed = behind_m_ < 0.0 && along_m >= 0.0;
    behind_m_ = along_m;
    return options_.reached.holds(state, waypoint) ||
           (crossed && options_.passed.holds(state, waypoint));
  }

  Law fresh_;
  Law law_;
  WaypointOptions options_;
  std::size_t next_ = 0;
  double behind_m_ = 1.0;  // along the waypoint's heading from it, at the last call
};

/// ShortestLaw for waypoints. `passed` is unset or wider than `reached`, which covers the step.
[[nodiscard]] inline WaypointLaw<ShortestLaw> shortest_waypoint_law(const WaypointOptions& options,
                                                                    double tie_m) {
  const bool wider = options.passed.place_m > options.reached.place_m &&
                     options.passed.heading_rad > options.reached.heading_rad;
  return {ShortestLaw({wider ? options.passed : options.reached, tie_m}), options};
}

struct WaypointLeg {
  State begin;
  State end;
  double length_m = 0.0;
  double shortest_m = 0.0;  ///< of the shortest path from `begin` to the waypoint
  bool reached = false;     ///< else passed, or given up
  bool converged = false;   ///< reached or passed
  int extra_turns = 0;  ///< by how many whole turns it is longer than the shortest path, rounded
  std::string word;     ///< as SteeringFlight::word
  std::vector<State> track;  ///< one state a step, with the first and the last, when asked for
};

struct WaypointFlight {
  bool converged = false;  ///< to every waypoint
  double length_m = 0.0;
  std::vector<WaypointLeg> legs;  ///< one per waypoint; up to the first that is given up
};

/// Drives from `from` along all waypoints; a leg is given up after the length that
/// steering_options() allows it. `disturbed`, if set, gives the vehicle's actual state after a
/// step. Throws PreconditionViolation unless can_steer() from each to the
/// next.
template <typename Law>
[[nodiscard]] WaypointFlight follow_waypoints(
    WaypointLaw<Law> law, const State& from, std::span<const State> waypoints, double turn_radius_m,
    double step_m, Track track = Track::none,
    const std::function<State(const State&)>& disturbed = {});

extern template WaypointFlight follow_waypoints<ClfLaw>(WaypointLaw<ClfLaw>, const State&,
                                                        std::span<const State>, double, double,
                                                        Track,
                                                        const std::function<State(const State&)>&);
extern template WaypointFlight follow_waypoints<ShortestLaw>(
    WaypointLaw<ShortestLaw>, const State&, std::span<const State>, double, double, Track,
    const std::function<State(const State&)>&);

}  // namespace fairway
