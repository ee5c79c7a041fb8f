// What makes a log unfit to say anything about a vehicle.
#pragma once

#include "fairway/identify/flight_log.hpp"

namespace fairway {

/// Throws InputError{NAME:LINE, ...} for time that does not grow, gaps, jumps of place, courses
/// that are not the direction of the motion, and a log too short to judge.
void require_sound(const FlightLog& log);

/// Throws InputError{NAME, ...} for a log that never turns, or whose command never changes: nothing
/// can be fitted to it.
void require_turns(const FlightLog& log, double turn_radius_m);

/// Throws InputError{NAME:LINE, ...} where samples are too far apart for a turn of this radius.
void require_fine(const FlightLog& log, double turn_radius_m);

}  // namespace fairway
