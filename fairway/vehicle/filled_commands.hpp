// Which command a vehicle takes where a cell has none: that of the nearest cell that has one. The
// proof under a contract and the vehicle must agree on it (vehicle/contract.hpp, rule 1).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "fairway/base/grid.hpp"

namespace fairway {

/// For every cell, [iy][ix]: the index of the nearest cell that `has`, by distance between centres,
/// of equally near ones the first in the array. grid.size() everywhere when none has.
[[nodiscard]] std::vector<std::size_t> nearest_cells(const Grid& grid,
                                                     const std::function<bool(std::size_t)>& has);

/// The command of every cell, [iy][ix]: its own, else that of the nearest cell that has one, as
/// nearest_cells finds it. NaN everywhere when no cell has a command.
[[nodiscard]] std::vector<float> filled_commands(const Grid& grid, const float* heading_rad);

}  // namespace fairway
