// A behaviour within a contract with what justifies each of its steps: to be shown, or written.
#pragma once

#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

struct ExplainedStep {
  State start;
  double time_s = 0.0;  ///< at its start
  double length_m = 0.0;
  double radius_m = 0.0;     ///< of a turn
  int turn = 0;              ///< +1 left, -1 right, 0 straight
  double command_rad = 0.0;  ///< in force for the whole step, error included
  Vec2 command_m;            ///< the place whose command that is
};

/// Flown at the vehicle's nominal speed.
struct ExplainedBehaviour {
  std::vector<ExplainedStep> steps;
  State end;
  double time_s = 0.0;
};

}  // namespace fairway
