// Checks of command-line values, made while options are parsed, before any file is read: a wrong
// value is wrong usage (64), whereas an error in a file is bad input (65).
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "fairway/base/frame.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Finite, and above `low`, or at least `low`.
[[nodiscard]] CLI::Validator finite_above(double low);
[[nodiscard]] CLI::Validator finite_from(double low);
[[nodiscard]] CLI::Validator finite_number();

/// What `read` takes; else what it says, without the place that it names.
[[nodiscard]] CLI::Validator readable(std::function<void(const std::string&)> read);

/// `X,Y,H`; and the state that such a text stands for.
[[nodiscard]] CLI::Validator state_argument();
[[nodiscard]] State state_of_argument(const std::string& text);

/// `LAT,LON,COURSE` in degrees; and the state that such a text stands for.
[[nodiscard]] CLI::Validator earth_state_argument();
[[nodiscard]] EarthState earth_state_of_argument(const std::string& text);

/// An angle from 0 to half a turn, in radians or with the suffix deg; and its value in radians.
[[nodiscard]] CLI::Validator angle_argument();
[[nodiscard]] double angle_of_argument_rad(const std::string& text);

/// A picture file; its extension, .svg or .png, sets the format.
[[nodiscard]] CLI::Validator picture_argument();

}  // namespace fairway
