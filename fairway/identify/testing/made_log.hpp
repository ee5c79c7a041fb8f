// Logs of a made vehicle that keeps a known contract exactly: it obeys after a delay, turns on
// circles of drawn radii, and holds its course with an error that drifts.
#pragma once

#include <cstdint>

#include "fairway/identify/flight_log.hpp"

namespace fairway {

struct MadeVehicle {
  double speed_mps = 20.0;
  double radius_least_m = 57.0;
  double radius_most_m = 63.0;
  double delay_s = 0.5;
  double heading_error_rad = 0.01;
  double period_s = 0.1;       ///< between samples
  double longest_s = 12.0;     ///< between commands; the shortest is a quarter of it
  double most_turn_rad = 2.5;  ///< of a change of command
  bool forgets_sides = false;  ///< takes the shorter side at each command
  // One command that the vehicle does not obey, given between these times; none: both 0.
  double ignores_from_s = 0.0;
  double ignores_to_s = 0.0;
};

/// Places are exact; courses and commands are those of the motion. Deterministic in the seed.
[[nodiscard]] FlightLog made_log(const MadeVehicle& vehicle, double length_s, std::uint64_t seed);

}  // namespace fairway
