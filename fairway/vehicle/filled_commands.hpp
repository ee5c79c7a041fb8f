// The command of every cell, those without one of their own included.
#pragma once

#include <vector>

#include "fairway/base/grid.hpp"

namespace fairway {

/// [iy][ix]: the cell's own command, else that of the nearest cell that has one
/// (vehicle/nearest_command.hpp). NaN everywhere when no cell has a command.
[[nodiscard]] std::vector<float> filled_commands(const Grid& grid, const float* heading_rad);

}  // namespace fairway
