#include "fairway/field/distance_transform.hpp"

#include <algorithm>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

// Row of the nearest feature in the same column, or `none`.
using Row = std::uint16_t;
constexpr Row none = 0xffff;

// Columns are scanned in strips, so that the inner loops run along memory and vectorise.
constexpr std::size_t strip = 512;

void scan_down(const std::uint8_t* feature, Row* row, const Row* above, Row iy, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) row[i] = feature[i] != 0 ? iy : above[i];
}

void scan_up(Row* row, const Row* below, Row iy, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const int up = row[i] == none ? 0x20000 : iy - row[i];
    const int down = below[i] == none ? 0x20000 : below[i] - iy;
    row[i] = down < up ? below[i] : row[i];
  }
}

void nearest_in_columns(std::span<const std::uint8_t> feature, std::size_t nx, std::size_t ny,
                        std::vector<Row>& nearest_row) {
  for_ranges((nx + strip - 1) / strip, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s) {
      const std::size_t x = s * strip;
      const std::size_t n = std::min(strip, nx - x);
      std::vector<Row> nothing(n, none);
      const Row* above = nothing.data();
      for (std::size_t iy = 0; iy < ny; ++iy) {
        Row* row = &nearest_row[iy * nx + x];
        scan_down(&feature[iy * nx + x], row, above, static_cast<Row>(iy), n);
        above = row;
      }
      const Row* below = nothing.data();
      for (std::size_t iy = ny; iy-- > 0;) {
        Row* row = &nearest_row[iy * nx + x];
        scan_up(row, below, static_cast<Row>(iy), n);
        below = row;
      }
    }
  });
}

// One parabola of the lower envelope along a row: column x, squared column distance.
struct Parabola {
  std::int32_t x;
  std::int32_t height;
};

// Is the parabola `b` nowhere below both `a` and `c`, a.x < b.x < c.x? Maurer et al., Eq. 3
// with everything multiplied out: integers, no division.
bool hidden(Parabola a, Parabola b, Parabola c) {
  const std::int64_t ab = b.x - a.x;
  const std::int64_t bc = c.x - b.x;
  const std::int64_t ac = c.x - a.x;
  return ac * b.height - bc * a.height - ab * c.height >= ab * bc * ac;
}

int lower_envelope(const Row* row, int nx, int iy, Parabola* envelope) {
  int count = 0;
  for (int x = 0; x < nx; ++x) {
    if (row[x] == none) continue;
    const int dy = row[x] - iy;
    const Parabola next{x, dy * dy};
    while (count >= 2 && hidden(envelope[count - 2], envelope[count - 1], next)) --count;
    envelope[count++] = next;
  }
  return count;
}

template <bool squared_wanted, bool nearest_wanted>
void read_envelope(const Row* row, int nx, const Parabola* envelope, int count,
                   std::int32_t* squared, std::uint32_t* nearest) {
  int k = 0;
  for (int x = 0; x < nx; ++x) {
    auto distance = [&](int i) {
      const int dx = x - envelope[i].x;
      return dx * dx + envelope[i].height;
    };
    std::int32_t best = distance(k);
    while (k + 1 < count) {
      const std::int32_t after = distance(k + 1);
      if (after > best) break;
      best = after;
      ++k;
    }
    if constexpr (squared_wanted) squared[x] = best;
    if constexpr (nearest_wanted) {
      const int fx = envelope[k].x;
      nearest[x] = static_cast<std::uint32_t>(row[fx]) * static_cast<std::uint32_t>(nx) +
                   static_cast<std::uint32_t>(fx);
    }
  }
}

void transform_row(const Row* row, int nx, int iy, std::vector<Parabola>& envelope,
                   std::int32_t* squared, std::uint32_t* nearest) {
  const int count = lower_envelope(row, nx, iy, envelope.data());
  if (count == 0) {
    if (squared != nullptr) std::fill_n(squared, nx, no_feature_distance);
    if (nearest != nullptr) std::fill_n(nearest, nx, no_feature);
  } else if (squared != nullptr && nearest != nullptr) {
    read_envelope<true, true>(row, nx, envelope.data(), count, squared, nearest);
  } else if (squared != nullptr) {
    read_envelope<true, false>(row, nx, envelope.data(), count, squared, nearest);
  } else if (nearest != nullptr) {
    read_envelope<false, true>(row, nx, envelope.data(), count, squared, nearest);
  }
}

}  // namespace

void distance_transform(std::span<const std::uint8_t> feature, int nx, int ny,
                        const DistanceOutput& output) {
  require(nx >= 0 && ny >= 0 && nx <= largest_distance_side && ny <= largest_distance_side,
          "distance_transform: sides of the grid are 0 to 32767 cells");
  const auto columns = static_cast<std::size_t>(nx);
  const auto rows = static_cast<std::size_t>(ny);
  const std::size_t cells = columns * rows;
  require(feature.size() == cells, "distance_transform: one feature entry per cell");
  require(output.squared_cells.empty() || output.squared_cells.size() == cells,
          "distance_transform: one squared distance per cell, or none");
  require(output.nearest.empty() || output.nearest.size() == cells,
          "distance_transform: one nearest feature per cell, or none");
  if (cells == 0) return;

  std::vector<Row> nearest_row(cells);
  nearest_in_columns(feature, columns, rows, nearest_row);
  for_rows(ny, [&](int first, int last) {
    std::vector<Parabola> envelope(columns);
    for (int iy = first; iy < last; ++iy) {
      const std::size_t at = static_cast<std::size_t>(iy) * columns;
      transform_row(&nearest_row[at], nx, iy, envelope,
                    output.squared_cells.empty() ? nullptr : &output.squared_cells[at],
                    output.nearest.empty() ? nullptr : &output.nearest[at]);
    }
  });
}

}  // namespace fairway
