// Numbers as messages show them: exactly as many digits as are useful.
#pragma once

#include <string>

#include "fairway/base/grid.hpp"
#include "fairway/base/vec2.hpp"

namespace fairway {

/// A coordinate, metres: the shortest decimal that is right to the centimetre (off by at most half
/// of one), never in scientific notation. "5200009.5", "-16.2", "0".
[[nodiscard]] std::string coordinate_text(double x_m);

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
