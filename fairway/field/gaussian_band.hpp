// The inner work of the Gaussian filter: a band of whole rows, in place, along rows and columns in
// one pass over memory.
//
// Built for three vector widths and chosen when the program runs; every width does the same
// operations on every cell in the same order, without fused multiply-add: the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace fairway {

struct GaussianBand {
  float* plane;              ///< [iy][ix], of the whole grid
  const float* below;        ///< the rows of the grid from first_row - reach, as they were
  const float* above;        ///< the rows of the grid from last_row, `reach` of them, as they were
  const std::uint8_t* wall;  ///< [iy][ix], of the whole grid, or nullptr: no walls
  std::size_t columns;
  std::size_t rows;       ///< of the grid
  std::size_t first_row;  ///< of the band
  std::size_t last_row;   ///< not of the band any more
  const float* weight;    ///< weight[k] at distance k, 0 <= k <= reach
  std::size_t reach;
};

/// Filters the band's rows in place. `below` and `above` hold what rows the grid has there.
void filter_band(const GaussianBand& band);

/// One for every width that this machine can run, narrowest first.
using BandFilter = void (*)(const GaussianBand&);
[[nodiscard]] std::span<const BandFilter> band_filters();

}  // namespace fairway
