#include "fairway/field/gaussian_band.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "fairway/field/gaussian_lanes.hpp"
#include "fairway/field/gaussian_sums.hpp"

// Along columns a vector of neighbouring cells moves from row to row: loads are aligned and shared
// by four outputs. Rows are transposed, 16 of them at a time, so that the same code runs along
// them. The part transposed at a time and the part of the columns in use at a time each fit into
// the first-level cache.

namespace fairway {
namespace {

using lanes::abreast;
using lanes::line;
using lanes::marked_wall;
using lanes::Scratch;
using lanes::scratch;
using lanes::Sight;
using lanes::Vector;

constexpr std::size_t group_rows = 32;  // rows filtered along columns at a time
constexpr std::size_t block = 64;       // columns stored together in a tile
constexpr std::size_t chunk = 256;      // columns transposed at a time
std::size_t whole(std::size_t count, std::size_t unit) { return (count + unit - 1) / unit * unit; }

struct Work {
  explicit Work(const GaussianBand& b)
      : tile_rows(2 * b.reach + group_rows + line),
        row_length(whole(chunk + 2 * b.reach, line)),
        tiles(scratch<float>(whole(b.columns, chunk) * tile_rows)),
        rows(scratch<float>(line * (row_length + line))),
        turned(scratch<float>(line * row_length)),
        sight(b.wall == nullptr ? 0 : std::max(row_length, tile_rows)) {}
  /// Rows first_row - reach, ... of a group, filtered along rows: [columns / block][row][block].
  float* tile(std::size_t column, std::size_t row) const {
    return tiles.get() + (column / block * tile_rows + row) * block + column % block;
  }
  std::size_t tile_rows;
  std::size_t row_length;
  Scratch<float> tiles;
  Scratch<float> rows;    // 16 rows of a chunk, padded by the reach; an extra line against aliasing
  Scratch<float> turned;  // the same, transposed
  Sight sight;
};

/// `count` cells of a row, walls marked.
template <typename V>
[[gnu::always_inline]] inline void copy_marked(const float* row, const std::uint8_t* wall,
                                               std::size_t count, float* out) {
  std::size_t i = 0;
  for (; i + V::count <= count; i += V::count) {
    const auto blocked = __builtin_convertvector(V::anywhere(wall + i), typename V::Int) != 0;
    const typename V::Float value = V::anywhere(row + i);
    V::anywhere(out + i) = blocked ? marked_wall - typename V::Float{} : value + 0.0F;
  }
  for (; i < count; ++i) out[i] = wall[i] != 0 ? marked_wall : row[i] + 0.0F;
}

/// One row of a chunk with `reach` extra cells on both sides; zeros beyond the grid.
template <typename V, bool walls>
[[gnu::always_inline]] inline void fill(float* out, const GaussianBand& b, std::ptrdiff_t iy,
                                        std::size_t first_column, std::size_t length) {
  const auto reach = static_cast<std::ptrdiff_t>(b.reach);
  const auto first_row = static_cast<std::ptrdiff_t>(b.first_row);
  const auto last_row = static_cast<std::ptrdiff_t>(b.last_row);
  const auto rows = static_cast<std::ptrdiff_t>(b.rows);
  if (iy < 0 || iy >= std::min(rows, last_row + reach)) {
    std::fill_n(out, length, 0.0F);
    return;
  }
  const auto columns = static_cast<std::ptrdiff_t>(b.columns);
  const float* row = iy < first_row  ? b.below + (iy - (first_row - reach)) * columns
                     : iy < last_row ? b.plane + iy * columns
                                     : b.above + (iy - last_row) * columns;
  const std::size_t from = first_column > b.reach ? first_column - b.reach : 0;
  const std::size_t to = std::min(first_column + length - b.reach, b.columns);
  const std::size_t before = from + b.reach - first_column;  // cells of `out` beyond the grid
  std::fill_n(out, before, 0.0F);
  if constexpr (walls) {
    copy_marked<V>(row + from, b.wall + iy * columns + static_cast<std::ptrdiff_t>(from), to - from,
                   out + before);
  } else {
    std::copy(row + from, row + to, out + before);
  }
  std::fill_n(out + before + (to - from), length - before - (to - from), 0.0F);
}

/// 16 rows of the grid from row `iy` into the tiles' rows from `at`, filtered along rows.
template <typename V, bool walls>
[[gnu::always_inline]] inline void enter_rows(const GaussianBand& b, Work& work, std::ptrdiff_t iy,
                                              std::size_t at) {
  const std::size_t stride = work.row_length + line;
  for (std::size_t first = 0; first < b.columns; first += chunk) {
    const std::size_t n = std::min(chunk, whole(b.columns - first, line));
    const std::size_t length = whole(n + 2 * b.reach, line);
    for (std::size_t i = 0; i < line; ++i) {
      fill<V, walls>(work.rows.get() + i * stride, b, iy + static_cast<std::ptrdiff_t>(i), first,
                     length);
    }
    for (std::size_t x = 0; x < length; x += line) {
      lanes::transpose_square<V>(work.rows.get() + x, stride, work.turned.get() + x * line, line);
    }
    if constexpr (walls) lanes::look<V, line>(work.turned.get(), n + 2 * b.reach, work.sight);
    for (std::size_t x = 0; x < n; x += line) {
      alignas(64) std::array<float, line * line> square;
      for (std::size_t i = 0; i < line; i += abreast) {
        lanes::four_lines<V, walls, line>({b.weight, b.reach}, work.turned.get(), b.reach + x + i,
                                          work.sight, marked_wall, square.data() + i * line);
      }
      lanes::transpose_square<V>(square.data(), line, work.tile(first + x, at), block);
    }
  }
}

/// One block of columns of the rows of a group, back into the plane.
template <typename V, bool walls>
[[gnu::always_inline]] inline void along_columns(const GaussianBand& b, Work& work,
                                                 std::size_t first, std::size_t group,
                                                 std::size_t rows) {
  alignas(64) std::array<float, line * abreast> four;
  for (std::size_t x = 0; x < block && first + x < b.columns; x += line) {
    const float* cells = work.tile(first + x, 0);
    const std::size_t n = std::min(line, b.columns - first - x);
    if constexpr (walls) lanes::look<V, block>(cells, group_rows + 2 * b.reach, work.sight);
    for (std::size_t i = 0; i < rows; i += abreast) {
      lanes::four_lines<V, walls, block>({b.weight, b.reach}, cells, b.reach + i, work.sight, 0.0F,
                                         four.data());
      for (std::size_t j = 0; j < std::min(abreast, rows - i); ++j) {
        float* out = b.plane + (group + i + j) * b.columns + first + x;
        if (n == line) {
          std::memcpy(out, four.data() + j * line, sizeof(float) * line);
        } else {
          std::copy_n(four.data() + j * line, n, out);
        }
      }
    }
  }
}

template <std::size_t bytes, bool walls>
[[gnu::always_inline]] inline void filter_rows(const GaussianBand& b) {
  using V = Vector<bytes>;
  Work work(b);
  const std::size_t kept = 2 * b.reach;  // rows of a tile that the next group also needs
  std::size_t next = 0;
  for (std::size_t group = b.first_row; group < b.last_row; group += group_rows) {
    const std::ptrdiff_t lowest =
        static_cast<std::ptrdiff_t>(group) - static_cast<std::ptrdiff_t>(b.reach);
    for (; next < kept + group_rows; next += line) {
      enter_rows<V, walls>(b, work, lowest + static_cast<std::ptrdiff_t>(next), next);
    }
    const std::size_t rows = std::min(group_rows, b.last_row - group);
    for (std::size_t x = 0; x < b.columns; x += block) {
      along_columns<V, walls>(b, work, x, group, rows);
      std::memmove(work.tile(x, 0), work.tile(x, group_rows),
                   (next - group_rows) * block * sizeof(float));
    }
    next -= group_rows;
  }
}

template <std::size_t bytes>
[[gnu::always_inline]] inline void filter_with(const GaussianBand& b) {
  if (b.wall == nullptr) {
    filter_rows<bytes, false>(b);
  } else {
    filter_rows<bytes, true>(b);
  }
}

void filter_baseline(const GaussianBand& b) { filter_with<16>(b); }

#if defined(__x86_64__)
[[gnu::target("avx2")]] void filter_avx2(const GaussianBand& b) { filter_with<32>(b); }
[[gnu::target("avx512f")]] void filter_avx512(const GaussianBand& b) { filter_with<64>(b); }
#endif

std::vector<BandFilter> available() {
  std::vector<BandFilter> filters{filter_baseline};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) filters.push_back(filter_avx2);
  if (__builtin_cpu_supports("avx512f")) filters.push_back(filter_avx512);
#endif
  return filters;
}

}  // namespace

std::span<const BandFilter> band_filters() {
  static const std::vector<BandFilter> filters = available();
  return filters;
}

void filter_band(const GaussianBand& band) { band_filters().back()(band); }

}  // namespace fairway
