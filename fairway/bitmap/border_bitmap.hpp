// The noun of the paper's method: for every inner border of a grid a bitmap of the sample states
// (position along the border, heading) from which the region of interest is reached (paper 2,
// section V.B). A picture of the backward reachable set, not a proof: samples say nothing certain
// about the states between them.
//
// Memory: m^2 bits for each of the nx (ny - 1) + ny (nx - 1) inner borders, the paper's figure
// m^2 (2 n (n - 1)) for a square grid (each border rounded up to whole 64-bit words). The grid's
// outer borders are not kept: a flight that meets one leaves, and none enters.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "fairway/base/grid.hpp"
#include "fairway/bitmap/bitmap_words.hpp"
#include "fairway/vehicle/side.hpp"

namespace fairway {

/// Numbering of the inner borders: first those between neighbours in a row, [iy][ix] by the cell on
/// their left, then those between neighbours in a column, [iy][ix] by the cell below.
struct BorderNumbers {
  int nx = 0;
  int ny = 0;

  std::size_t upright() const {
    return nx > 1 ? static_cast<std::size_t>(nx - 1) * static_cast<std::size_t>(ny) : 0;
  }
  std::size_t count() const {
    return upright() +
           (ny > 1 ? static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny - 1) : 0);
  }
  bool is_inner(Cell c, Side side) const {
    return side == Side::right  ? c.ix + 1 < nx
           : side == Side::top  ? c.iy + 1 < ny
           : side == Side::left ? c.ix > 0
                                : c.iy > 0;
  }
  /// The number of an inner border of a cell.
  std::size_t of(Cell c, Side side) const {
    const int ix = side == Side::left ? c.ix - 1 : c.ix;
    const int iy = side == Side::bottom ? c.iy - 1 : c.iy;
    const bool stands = side == Side::right || side == Side::left;
    return stands ? static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx - 1) +
                        static_cast<std::size_t>(ix)
                  : upright() + static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) +
                        static_cast<std::size_t>(ix);
  }
  bool is_upright(std::size_t border) const { return border < upright(); }
  /// The cell to the left of or below a border.
  Cell cell_before(std::size_t border) const {
    const bool stands = is_upright(border);
    const std::size_t place = stands ? border : border - upright();
    const auto row = static_cast<std::size_t>(stands ? nx - 1 : nx);
    return {static_cast<int>(place % row), static_cast<int>(place / row)};
  }
};

struct BorderBitmap {
  Grid grid;
  int samples = 0;    ///< m, see bitmap_samples.hpp
  BitmapWords words;  ///< [border][words_per_border()]; bit heading * m + position of a border

  BorderNumbers borders() const { return {grid.nx, grid.ny}; }
  std::size_t states_per_border() const {
    return static_cast<std::size_t>(samples) * static_cast<std::size_t>(samples);
  }
  std::size_t words_per_border() const { return (states_per_border() + 63) / 64; }
  std::size_t bytes() const { return 8 * words.size(); }

  bool reached(std::size_t border, int heading, int position) const {
    const std::size_t bit = static_cast<std::size_t>(heading) * static_cast<std::size_t>(samples) +
                            static_cast<std::size_t>(position);
    return (words[border * words_per_border() + bit / 64] >> (bit % 64) & 1) != 0;
  }
  std::size_t count_reached() const {
    std::size_t bits = 0;
    for (std::size_t i = 0; i < words.size(); ++i)
      bits += static_cast<std::size_t>(std::popcount(words[i]));
    return bits;
  }
  /// The share of all sample states of inner borders; 0 without borders.
  double share_reached() const {
    const std::size_t all = borders().count() * states_per_border();
    return all > 0 ? static_cast<double>(count_reached()) / static_cast<double>(all) : 0.0;
  }

  friend bool operator==(const BorderBitmap&, const BorderBitmap&) = default;
};

}  // namespace fairway
