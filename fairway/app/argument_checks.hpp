// What a value on the command line must be. Checked while options are parsed, before any file is
// read: a wrong one is wrong usage (64), while what is wrong in a file is bad input (65).
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "fairway/base/frame.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Finite, and above `low`, or from it on.
[[nodiscard]] CLI::Validator finite_above(double low);
[[nodiscard]] CLI::Validator finite_from(double low);
[[nodiscard]] CLI::Validator finite_number();

/// `X,Y,H`; and the state that a text so checked stands for.
[[nodiscard]] CLI::Validator state_argument();
[[nodiscard]] State state_of_argument(const std::string& text);

/// `LAT,LON,COURSE` in degrees; and the state that a text so checked stands for.
[[nodiscard]] CLI::Validator earth_state_argument();
[[nodiscard]] EarthState earth_state_of_argument(const std::string& text);

/// An angle from 0 to half a turn, in radians or with the suffix deg; and its radians.
[[nodiscard]] CLI::Validator angle_argument();
[[nodiscard]] double angle_of_argument_rad(const std::string& text);

/// A picture's file, as SVG or PNG by its ending.
[[nodiscard]] CLI::Validator picture_argument();

}  // namespace fairway
