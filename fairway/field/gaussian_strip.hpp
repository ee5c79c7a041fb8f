// The inner work of the Gaussian filter: one strip of columns, rows first, then columns, in one
// pass over memory. The rows already filtered wait in a ring of 2 r + 1 rows that stays in the
// cache.
//
// Built for three vector widths and chosen when the program runs; every width does the same
// operations on every cell in the same order, without fused multiply-add: the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace fairway {

inline constexpr std::size_t gaussian_strip_width = 256;
inline constexpr std::size_t gaussian_piece_rows = 1024;

struct GaussianPlane {
  const float* in;           ///< [iy][ix]
  const std::uint8_t* wall;  ///< [iy][ix], or nullptr: no walls
  float* out;                ///< [iy][ix], not `in`
  std::size_t columns;
  std::size_t rows;
  const float* weight;  ///< weight[k] at distance k, 0 <= k <= reach
  std::size_t reach;
};

/// Fills the columns from `first_column` (a strip) of the rows from `first_row` (a piece).
void filter_strip(const GaussianPlane& plane, std::size_t first_column, std::size_t first_row);

/// The widths this machine can run, narrowest first, for the test that all give the same bits.
using StripFilter = void (*)(const GaussianPlane&, std::size_t first_column, std::size_t first_row);
[[nodiscard]] std::span<const StripFilter> strip_filters();

}  // namespace fairway
