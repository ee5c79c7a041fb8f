// Driving to a pose under a feedback law, exactly: the curvature is constant over each control
// step, so every step is an arc or a straight line in closed form.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/steer/clf_law.hpp"
#include "fairway/steer/shortest_law.hpp"

namespace fairway {

struct SteeringOptions {
  double step_m = 0.0;  ///< how far the vehicle drives between two controls, > 0
  PoseTolerance tolerance;
  double length_limit_m = 0.0;
};

/// How far apart poses may be, in radii, for a flight in steps to end in reasonable time: ten
/// million steps.
inline constexpr double farthest_flown_radii = 1e4;

/// Steps of a hundredth of the radius, converged within a fiftieth of it and of a radian, given up
/// after three times the distance and sixty radii.
[[nodiscard]] SteeringOptions steering_options(const State& from, const State& goal,
                                               double turn_radius_m);

struct SteeringFlight {
  bool converged = false;
  double length_m = 0.0;
  State end;
  std::string word;          ///< L, S, R as driven; parts shorter than four steps are left out
  std::vector<State> track;  ///< one state a step, with the first and the last, when asked for
};

enum class Track { none, all };

/// Disturbances while a vehicle steers. Either may be empty.
struct SteeringWorld {
  /// The vehicle's actual state after a step.
  std::function<State(const State&)> disturbed = {};
  /// The goal once the vehicle has driven this far, metres; else the flight's.
  std::function<State(double driven_m)> goal = {};
};

/// A goal that moves along its heading, and gusts.
struct SteeringUnrest {
  double goal_speed = 0.0;  ///< of the vehicle's
  double noise_m = 0.0;  ///< standard deviation of x and y after each step, over r of the heading
  Random random{1};      ///< of the gusts
};
[[nodiscard]] SteeringWorld world_of(const SteeringUnrest& unrest, const State& goal,
                                     double turn_radius_m);

/// Drives under a law until the vehicle is within the tolerance of the goal's current pose, or has
/// driven the length limit. Throws PreconditionViolation unless can_steer(), the step is
/// positive and the limit finite.
[[nodiscard]] SteeringFlight fly(ClfLaw& law, const State& from, const State& goal,
                                 double turn_radius_m, const SteeringOptions& options,
                                 Track track = Track::none, const SteeringWorld& world = {});
[[nodiscard]] SteeringFlight fly(ShortestLaw& law, const State& from, const State& goal,
                                 double turn_radius_m, const SteeringOptions& options,
                                 Track track = Track::none, const SteeringWorld& world = {});

}  // namespace fairway
