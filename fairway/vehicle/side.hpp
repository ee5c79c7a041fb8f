// The four sides of a cell.
#pragma once

#include <cstdint>

namespace fairway {

/// Counter-clockwise, so that a quarter turn adds one.
enum class Side : std::uint8_t { right = 0, top = 1, left = 2, bottom = 3 };

}  // namespace fairway
