// Reads a flight log from a CSV file and refuses what cannot be one.
//
// Columns are found by name. Two sets of names are known: t_s,x_m,y_m,course_rad,command_rad
// (angles counter-clockwise from east), and t_s,x_east_m,y_north_m,course_rad,command_rad (angles
// clockwise from north). Other names are given by the format.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fairway/identify/flight_log.hpp"

namespace fairway {

enum class LogAngles : std::uint8_t {
  by_names,  ///< as the set of names says; counter-clockwise for names that were given
  east_ccw_rad,
  north_cw_rad,
  north_cw_deg
};

struct LogFormat {
  /// Names of time, x, y, course, command; empty: the known sets are tried.
  std::vector<std::string> columns;
  LogAngles angles = LogAngles::by_names;
};

/// The names of time=T,x=X,y=Y,course=C,command=D in the order of LogFormat::columns, the known
/// ones where a part is left out. Throws InputError{where, ...}.
[[nodiscard]] std::vector<std::string> log_columns_of(const std::string& text,
                                                      const std::string& where);

/// Throws InputError{FILE:LINE, ...}: a missing column, time that does not grow, a gap, a jump of
/// place, angles in degrees, courses that are not the direction of the motion, a log too short.
[[nodiscard]] FlightLog read_flight_log(const std::string& file, const LogFormat& format);

}  // namespace fairway
