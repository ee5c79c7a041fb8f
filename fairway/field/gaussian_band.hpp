// The inner work of the Gaussian filter: a band of whole rows, in place, along rows and columns in
// one pass over memory.
//
// Built for three vector widths, chosen at run time; every width does the same operations on every
// cell in the same order, without fused multiply-add, and gives the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace fairway {

struct GaussianBand {
  float* plane;              ///< [iy][ix], of the whole grid
  const float* below;        ///< the original rows of the grid from first_row - reach
  const float* above;        ///< `reach` original rows of the grid from last_row
  const std::uint8_t* wall;  ///< [iy][ix], of the whole grid, or nullptr: no walls
  std::size_t columns;
  std::size_t rows;       ///< of the grid
  std::size_t first_row;  ///< of the band
  std::size_t last_row;   ///< one past the band
  const float* weight;    ///< weight[k] at distance k, 0 <= k <= reach
  std::size_t reach;
};

/// Filters the band's rows in place. `below` and `above` hold the rows that the grid has there.
void filter_band(const GaussianBand& band);

/// One for each width that this machine supports, narrowest first.
using BandFilter = void (*)(const GaussianBand&);
[[nodiscard]] std::span<const BandFilter> band_filters();

}  // namespace fairway
