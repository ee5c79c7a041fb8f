// Numbers as messages show them: exactly as many digits as are useful.
#pragma once

#include <string>

#include "fairway/base/grid.hpp"
#include "fairway/base/vec2.hpp"

namespace fairway {

/// A coordinate, metres: the shortest decimal that is right to the centimetre (off by at most half
/// of one), never in scientific notation. "5200009.5", "-16.2", "0".
[[nodiscard]] std::string coordinate_text(double x_m);

/// The same in as many decimals as asked for, from 0 on, without the zeros at their end.
[[nodiscard]] std::string decimal_text(double value, int decimals);

/// A positive number of `digits` digits that is at most `value`, for a limit that is still to hold
/// once it is printed: "{:.4g}" shows one of 4 digits whole.
[[nodiscard]] double rounded_down(double value, int digits);

/// The same for a bound from above: at least `value`.
[[nodiscard]] double rounded_up(double value, int digits);

/// A share from 0 to 1 as "97 %", rounded down, and not to nothing: "under 1 %".
[[nodiscard]] std::string whole_percent_text(double share);

/// A length: the same, but below one metre it has three significant digits: "0.00125".
[[nodiscard]] std::string length_text(double length_m);

/// "(x, y)" in coordinates.
[[nodiscard]] std::string place_text(Vec2 p_m);

/// "(x, y) is outside the map, expected x in [a, b] and y in [c, d]", with as many extra decimals
/// as needed for the printed place to be outside, too.
[[nodiscard]] std::string outside_text(Vec2 p_m, const Grid& grid);

/// True on the grid, including its border.
[[nodiscard]] bool is_within(const Grid& grid, Vec2 p_m);

}  // namespace fairway
