#include "fairway/steer/steering_flight.hpp"

#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/steer/driven_word.hpp"

namespace fairway {
namespace {

template <typename Law>
SteeringFlight flown(Law& law, const State& from, const State& goal, double turn_radius_m,
                     const SteeringOptions& options, Track track, const SteeringWorld& world) {
  require(can_steer(from, goal, turn_radius_m), "poses are finite, the turning radius is positive");
  require(options.step_m > 0.0 && std::isfinite(options.length_limit_m),
          "the step is positive and the flight ends");
  SteeringFlight flight;
  flight.end = from;
  DrivenWord word;
  const auto steps = static_cast<std::size_t>(options.length_limit_m / options.step_m);
  for (std::size_t i = 0;; ++i) {
    if (track == Track::all) flight.track.push_back(flight.end);
    const State now = world.goal ? world.goal(flight.length_m) : goal;
    flight.converged = options.tolerance.holds(flight.end, now);
    if (flight.converged || i == steps) break;
    const double per_m = law.curvature_per_m(flight.end, now, turn_radius_m, options.step_m);
    word.add(per_m * turn_radius_m, options.step_m);
    flight.end = driven(flight.end, options.step_m, per_m);
    if (world.disturbed) flight.end = world.disturbed(flight.end);
    flight.length_m = static_cast<double>(i + 1) * options.step_m;
  }
  flight.word = word.text(3.5 * options.step_m);
  return flight;
}

}  // namespace

SteeringOptions steering_options(const State& from, const State& goal, double turn_radius_m) {
  return {0.01 * turn_radius_m,
          {0.02 * turn_radius_m, 0.02},
          3.0 * norm(goal.position_m - from.position_m) + 60.0 * turn_radius_m};
}

SteeringWorld world_of(const SteeringUnrest& unrest, const State& goal, double turn_radius_m) {
  SteeringWorld world;
  if (unrest.goal_speed != 0.0) {
    world.goal = [goal, speed = unrest.goal_speed](double driven_m) {
      return driven(goal, speed * driven_m, 0.0);
    };
  }
  if (unrest.noise_m > 0.0) {
    world.disturbed = [noise_m = unrest.noise_m, turn_radius_m,
                       random = unrest.random](const State& s) mutable {
      const double x_m = noise_m * random.normal();
      const double y_m = noise_m * random.normal();
      const double turn_rad = noise_m / turn_radius_m * random.normal();
      return State{s.position_m + Vec2{x_m, y_m}, Heading::from_rad(s.heading.rad() + turn_rad)};
    };
  }
  return world;
}

SteeringFlight fly(ClfLaw& law, const State& from, const State& goal, double turn_radius_m,
                   const SteeringOptions& options, Track track, const SteeringWorld& world) {
  return flown(law, from, goal, turn_radius_m, options, track, world);
}

SteeringFlight fly(ShortestLaw& law, const State& from, const State& goal, double turn_radius_m,
                   const SteeringOptions& options, Track track, const SteeringWorld& world) {
  return flown(law, from, goal, turn_radius_m, options, track, world);
}

}  // namespace fairway
