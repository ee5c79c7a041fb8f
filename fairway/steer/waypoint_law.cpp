#include "fairway/steer/waypoint_law.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/steer/driven_word.hpp"

namespace fairway {
namespace {

/// A leg being driven.
struct UnderWay {
  WaypointLeg leg;
  DrivenWord word;
  double limit_m = 0.0;
  std::size_t steps = 0;
};

UnderWay begun(const State& at, const State& waypoint, double turn_radius_m) {
  UnderWay now;
  now.leg.begin = at;
  now.leg.shortest_m = shortest_length_m(at, waypoint, turn_radius_m);
  now.limit_m = steering_options(at, waypoint, turn_radius_m).length_limit_m;
  return now;
}

WaypointLeg ended(UnderWay now, const State& at, const PoseTolerance& reached,
                  const State& waypoint, double turn_radius_m, double step_m) {
  WaypointLeg& leg = now.leg;
  leg.end = at;
  leg.reached = reached.holds(at, waypoint);
  leg.word = now.word.text(3.5 * step_m);
  const double turns = (leg.length_m - leg.shortest_m) / (two_pi * turn_radius_m);
  leg.extra_turns = static_cast<int>(std::lround(std::max(0.0, turns)));
  return std::move(leg);
}

}  // namespace

template <typename Law>
WaypointFlight follow_waypoints(WaypointLaw<Law> law, const State& from,
                                std::span<const State> waypoints, double turn_radius_m,
                                double step_m, Track track,
                                const std::function<State(const State&)>& disturbed) {
  require(step_m > 0.0, "the step is positive");
  WaypointFlight flight;
  State at = from;
  std::optional<UnderWay> now;
  while (flight.legs.size() < waypoints.size()) {
    if (!now) now = begun(at, waypoints[flight.legs.size()], turn_radius_m);
    if (track == Track::all) now->leg.track.push_back(at);
    const double per_m = law.curvature_per_m(at, waypoints, turn_radius_m, step_m);
    while (flight.legs.size() < law.next()) {
      const State& waypoint = waypoints[flight.legs.size()];
      flight.legs.push_back(
          ended(std::move(*now), at, law.options().reached, waypoint, turn_radius_m, step_m));
      flight.legs.back().converged = true;
      if (flight.legs.size() == waypoints.size()) break;
      now = begun(at, waypoints[flight.legs.size()], turn_radius_m);
      if (track == Track::all) now->leg.track.push_back(at);
    }
    if (flight.legs.size() == waypoints.size()) break;
    if (now->leg.length_m >= now->limit_m) {
      flight.legs.push_back(ended(std::move(*now), at, law.options().reached,
                                  waypoints[flight.legs.size()], turn_radius_m, step_m));
      break;
    }
    now->word.add(per_m * turn_radius_m, step_m);
    now->leg.length_m = static_cast<double>(++now->steps) * step_m;
    at = driven(at, step_m, per_m);
    if (disturbed) at = disturbed(at);
  }
  flight.converged = flight.legs.size() == waypoints.size();
  for (const WaypointLeg& leg : flight.legs) {
    flight.length_m += leg.length_m;
    flight.converged = flight.converged && leg.converged;
  }
  return flight;
}

template WaypointFlight follow_waypoints<ClfLaw>(WaypointLaw<ClfLaw>, const State&,
                                                 std::span<const State>, double, double, Track,
                                                 const std::function<State(const State&)>&);
template WaypointFlight follow_waypoints<ShortestLaw>(WaypointLaw<ShortestLaw>, const State&,
                                                      std::span<const State>, double, double, Track,
                                                      const std::function<State(const State&)>&);

}  // namespace fairway
