// The Gaussian filter of the field (paper 1, Eqs. 19 to 21), separable: along rows, then columns.
//
// Kernel: weights exp(-k^2 / (2 sigma^2)) for |k| <= ceil(2 sigma), so n = 2 ceil(2 sigma) + 1
// (Eq. 20). Weights are not normalised: a constant factor does not change a direction, and at the
// map's edge the sum over the cells that exist is the normalised filter times a positive number.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fairway/field/vector_field.hpp"

namespace fairway {

/// Half width ceil(2 sigma) of the kernel.
[[nodiscard]] int gaussian_half_width(double sigma_cells);

/// Filters both components in place. sigma_cells > 0.
void gaussian_filter(VectorField& field, int nx, int ny, double sigma_cells);

/// The same, but a cell averages only what it sees along its row, then along its column, up to
/// the first wall (`wall`: [iy][ix], nonzero). Walls themselves do not contribute.
void gaussian_filter_between_walls(VectorField& field, std::span<const std::uint8_t> wall, int nx,
                                   int ny, double sigma_cells);

}  // namespace fairway
