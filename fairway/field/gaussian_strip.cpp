#include "fairway/field/gaussian_strip.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace fairway {
namespace {

// A vector of floats of the compiler's own kind, element by element like the scalars they stand
// for, and the same anywhere in memory.
template <std::size_t bytes>
struct Vector {
  using Type [[gnu::vector_size(bytes)]] = float;
  using InMemory [[gnu::vector_size(bytes), gnu::aligned(4), gnu::may_alias]] = float;
  static constexpr std::size_t lanes = bytes / sizeof(float);
  static const InMemory& at(const float* p) { return *reinterpret_cast<const InMemory*>(p); }
  static InMemory& at(float* p) { return *reinterpret_cast<InMemory*>(p); }
};

constexpr std::size_t width = gaussian_strip_width;

// Rows are taken down the columns in groups: the part of the ring that a block of columns and a
// group of rows need fits into the first-level cache, and is loaded into it once a group, not once
// a row.
constexpr std::size_t group_rows = 64;
constexpr std::size_t column_block = 64;

// Rows of the ring, by their row on the grid. The stride is no power of two, so that the rows of a
// block do not compete for the same places of the cache.
struct Ring {
  explicit Ring(std::size_t reach) : slots(2 * reach + group_rows), cells(slots * stride) {}
  float* row(std::size_t iy) { return &cells[iy % slots * stride]; }
  static constexpr std::size_t stride = width + 16;
  std::size_t slots;
  std::vector<float> cells;
};

// One padded input row: value and, between walls, 1 where open; zeros beyond the grid.
struct PaddedRow {
  explicit PaddedRow(std::size_t reach)
      : value(width + 2 * reach + 16), open(width + 2 * reach + 16) {}
  std::vector<float> value;
  std::vector<float> open;
};

void fill(PaddedRow& row, const GaussianPlane& p, std::size_t first_column, std::size_t iy) {
  const std::size_t from = first_column > p.reach ? first_column - p.reach : 0;
  const std::size_t to = std::min(first_column + width + p.reach, p.columns);
  const std::size_t at = from + p.reach - first_column;  // place of column `from` in the row
  std::fill(row.value.begin(), row.value.end(), 0.0F);
  std::copy(p.in + iy * p.columns + from, p.in + iy * p.columns + to,
            row.value.begin() + static_cast<std::ptrdiff_t>(at));
  if (p.wall == nullptr) return;
  std::fill(row.open.begin(), row.open.end(), 0.0F);
  const std::uint8_t* wall = p.wall + iy * p.columns + from;
  for (std::size_t i = 0; i < to - from; ++i) {
    row.open[at + i] = wall[i] == 0 ? 1.0F : 0.0F;
    row.value[at + i] *= row.open[at + i];
  }
}

// Four vectors are summed side by side, so that additions need not wait for each other.
constexpr std::size_t abreast = 4;

template <typename V>
[[gnu::always_inline]] inline void along_row(const PaddedRow& row, const GaussianPlane& p,
                                             float* out) {
  for (std::size_t x = 0; x < width; x += abreast * V::lanes) {
    const float* value = row.value.data() + p.reach + x;
    std::array<typename V::Type, abreast> sum;
    for (std::size_t j = 0; j < abreast; ++j) sum[j] = V::at(value + j * V::lanes) * p.weight[0];
    for (std::size_t k = 1; k <= p.reach; ++k) {
      for (std::size_t j = 0; j < abreast; ++j) {
        const float* at = value + j * V::lanes;
        sum[j] += (V::at(at - k) + V::at(at + k)) * p.weight[k];
      }
    }
    for (std::size_t j = 0; j < abreast; ++j) V::at(out + x + j * V::lanes) = sum[j];
  }
}

template <typename V>
[[gnu::always_inline]] inline void along_open_row(const PaddedRow& row, const GaussianPlane& p,
                                                  float* out) {
  for (std::size_t x = 0; x < width; x += V::lanes) {
    const float* value = row.value.data() + p.reach + x;
    const float* open = row.open.data() + p.reach + x;
    typename V::Type sum = V::at(value) * p.weight[0];
    typename V::Type left = V::at(open);
    typename V::Type right = left;
    for (std::size_t k = 1; k <= p.reach; ++k) {
      left *= V::at(open - k);
      right *= V::at(open + k);
      sum += (left * V::at(value - k) + right * V::at(value + k)) * p.weight[k];
    }
    V::at(out + x) = sum;
  }
}

struct ColumnRows {
  std::vector<const float*> value;  // rows iy - reach .. iy + reach
  std::vector<const float*> open;
};

template <typename V>
[[gnu::always_inline]] inline void along_columns(const ColumnRows& rows, const GaussianPlane& p,
                                                 std::size_t first, float* out) {
  const float* const* value = rows.value.data() + p.reach;
  for (std::size_t x = first; x < first + column_block; x += abreast * V::lanes) {
    std::array<typename V::Type, abreast> sum;
    for (std::size_t j = 0; j < abreast; ++j) {
      sum[j] = V::at(value[0] + x + j * V::lanes) * p.weight[0];
    }
    for (std::size_t k = 1; k <= p.reach; ++k) {
      const float* below = value[-static_cast<std::ptrdiff_t>(k)] + x;
      const float* above = value[static_cast<std::ptrdiff_t>(k)] + x;
      for (std::size_t j = 0; j < abreast; ++j) {
        sum[j] += (V::at(below + j * V::lanes) + V::at(above + j * V::lanes)) * p.weight[k];
      }
    }
    for (std::size_t j = 0; j < abreast; ++j) V::at(out + x - first + j * V::lanes) = sum[j];
  }
}

template <typename V>
[[gnu::always_inline]] inline void along_open_columns(const ColumnRows& rows,
                                                      const GaussianPlane& p, std::size_t first,
                                                      float* out) {
  const float* const* value = rows.value.data() + p.reach;
  const float* const* open = rows.open.data() + p.reach;
  for (std::size_t x = first; x < first + column_block; x += V::lanes) {
    typename V::Type sum = V::at(value[0] + x) * p.weight[0];
    typename V::Type down = V::at(open[0] + x);
    typename V::Type up = down;
    for (std::size_t k = 1; k <= p.reach; ++k) {
      const auto d = static_cast<std::ptrdiff_t>(k);
      down *= V::at(open[-d] + x);
      up *= V::at(open[d] + x);
      sum += (down * V::at(value[-d] + x) + up * V::at(value[d] + x)) * p.weight[k];
    }
    V::at(out + x - first) = sum;
  }
}

// The rows around row `iy` of the grid; zeros beyond it.
void look_around(Ring& ring, std::size_t iy, const GaussianPlane& p,
                 const std::vector<float>& zeros, std::vector<const float*>& rows) {
  for (std::size_t k = 0; k <= 2 * p.reach; ++k) {
    const bool inside = iy + k >= p.reach && iy + k - p.reach < p.rows;
    rows[k] = inside ? ring.row(iy + k - p.reach) : zeros.data();
  }
}

template <std::size_t bytes>
[[gnu::always_inline]] inline void filter_with(const GaussianPlane& p, std::size_t first_column,
                                               std::size_t first_row) {
  using V = Vector<bytes>;
  const std::size_t last_row = std::min(first_row + gaussian_piece_rows, p.rows);
  const std::size_t n = std::min(width, p.columns - first_column);
  const bool walls = p.wall != nullptr;
  Ring filtered(p.reach);
  Ring open(p.reach);
  PaddedRow row(p.reach);
  const std::vector<float> zeros(width, 0.0F);
  std::vector<ColumnRows> around(group_rows, {std::vector<const float*>(2 * p.reach + 1),
                                              std::vector<const float*>(2 * p.reach + 1)});
  std::array<float, column_block> result;
  std::size_t next = first_row > p.reach ? first_row - p.reach : 0;  // row to enter the ring
  for (std::size_t group = first_row; group < last_row; group += group_rows) {
    const std::size_t rows = std::min(group_rows, last_row - group);
    for (; next < p.rows && next < group + rows + p.reach; ++next) {
      fill(row, p, first_column, next);
      if (walls) {
        along_open_row<V>(row, p, filtered.row(next));
        std::copy_n(row.open.data() + p.reach, width, open.row(next));
      } else {
        along_row<V>(row, p, filtered.row(next));
      }
    }
    for (std::size_t i = 0; i < rows; ++i) {
      look_around(filtered, group + i, p, zeros, around[i].value);
      if (walls) look_around(open, group + i, p, zeros, around[i].open);
    }
    for (std::size_t x = 0; x < n; x += column_block) {
      for (std::size_t i = 0; i < rows; ++i) {
        if (walls) {
          along_open_columns<V>(around[i], p, x, result.data());
        } else {
          along_columns<V>(around[i], p, x, result.data());
        }
        std::copy_n(result.data(), std::min(column_block, n - x),
                    p.out + (group + i) * p.columns + first_column + x);
      }
    }
  }
}

void filter_baseline(const GaussianPlane& p, std::size_t column, std::size_t row) {
  filter_with<16>(p, column, row);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void filter_avx2(const GaussianPlane& p, std::size_t column,
                                         std::size_t row) {
  filter_with<32>(p, column, row);
}
[[gnu::target("avx512f")]] void filter_avx512(const GaussianPlane& p, std::size_t column,
                                              std::size_t row) {
  filter_with<64>(p, column, row);
}
#endif

std::vector<StripFilter> available() {
  std::vector<StripFilter> filters{filter_baseline};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) filters.push_back(filter_avx2);
  if (__builtin_cpu_supports("avx512f")) filters.push_back(filter_avx512);
#endif
  return filters;
}

}  // namespace

std::span<const StripFilter> strip_filters() {
  static const std::vector<StripFilter> filters = available();
  return filters;
}

void filter_strip(const GaussianPlane& plane, std::size_t first_column, std::size_t first_row) {
  strip_filters().back()(plane, first_column, first_row);
}

}  // namespace fairway
