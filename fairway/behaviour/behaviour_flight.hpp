// One behaviour within a vehicle contract (vehicle/contract.hpp), as a list of short steps of
// constant curvature, each with the command that justifies it.
//
// A flight is exact by its definition: a turn is given by its radius and the heading it ends with,
// a straight step by its length. So all headings are known to the bit, and only positions have to
// be computed, with a bound on the error (proved_ends.hpp).
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "fairway/base/heading.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// The command in force is that of the very cell that the vehicle is in, whichever that is.
inline constexpr std::size_t own_cell = std::numeric_limits<std::size_t>::max();

struct BehaviourStep {
  int turn = 0;                 ///< +1 left, -1 right, 0 straight
  double radius_m = 0.0;        ///< of a turn
  double length_m = 0.0;        ///< of a straight step
  double heading_rad = 0.0;     ///< at the end, (-pi, pi]; of a straight step also before it
  std::size_t cell = own_cell;  ///< whose command is in force for the whole step
  double error_rad = 0.0;       ///< added to that command; a straight step: not used
};

struct BehaviourFlight {
  State start;
  std::vector<BehaviourStep> steps;
};

/// By how much a turn to `side` changes the heading `from_rad` until it is `to_rad`, in [0, 2 pi).
/// Both in (-pi, pi].
inline double turn_angle(double from_rad, double to_rad, int side) {
  const double turn = side * (to_rad - from_rad);
  return turn < 0.0 ? turn + two_pi : turn;
}

/// What a step moves, from heading `from_rad`.
inline Vec2 move_of(const BehaviourStep& step, double from_rad) {
  if (step.turn == 0) return step.length_m * Vec2{std::cos(from_rad), std::sin(from_rad)};
  return step.turn * step.radius_m *
         Vec2{std::sin(step.heading_rad) - std::sin(from_rad),
              std::cos(from_rad) - std::cos(step.heading_rad)};
}

inline double length_of(const BehaviourStep& step, double from_rad) {
  if (step.turn == 0) return step.length_m;
  return step.radius_m * turn_angle(from_rad, step.heading_rad, step.turn);
}

/// Pieces of constant curvature, steps that continue each other joined, flown at `speed_mps`.
[[nodiscard]] std::vector<FlightSegment> segments_of(const BehaviourFlight& flight,
                                                     double speed_mps);

}  // namespace fairway
