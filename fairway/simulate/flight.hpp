// The noun of simulation: one flight of a vehicle under a plan.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// What ends a flight, by what comes first (the contract's model section).
enum class Outcome : std::uint8_t { reach, collide, leave, trapped };

/// The name used in files and on screen.
constexpr const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::reach: return "reach";
    case Outcome::collide: return "collide";
    case Outcome::leave: return "leave";
    case Outcome::trapped: return "trapped";
  }
  return "";
}

/// Time and length are to the event that ends the flight; +inf when trapped.
struct FlightResult {
  Outcome outcome = Outcome::trapped;
  double time_s = 0.0;
  double length_m = 0.0;
};

/// One piece of constant curvature: from `start`, `length_m` long, curvature positive to the left.
struct FlightSegment {
  State start;
  double time_s = 0.0;  ///< at the start of the piece
  double length_m = 0.0;
  double curvature_per_m = 0.0;
};

struct Flight {
  State start;
  FlightResult result;
  std::vector<FlightSegment> segments;  ///< joined end to end; recorded only when asked for
};

}  // namespace fairway
