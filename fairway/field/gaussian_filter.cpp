#include "fairway/field/gaussian_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/field/gaussian_band.hpp"

namespace fairway {
namespace {

std::vector<float> kernel_of(double sigma_cells) {
  std::vector<float> weight(static_cast<std::size_t>(gaussian_half_width(sigma_cells)) + 1);
  for (std::size_t k = 0; k < weight.size(); ++k) {
    const double d = static_cast<double>(k) / sigma_cells;
    weight[k] = static_cast<float>(std::exp(-0.5 * d * d));  // Eq. 19 along one axis
  }
  return weight;
}

// Bands are filtered in parallel and in place, so each needs copies of its neighbours' nearest
// rows, made before any band starts. Bands are tall enough that these stay few.
constexpr std::size_t least_band_rows = 1024;
constexpr std::size_t band_rows_per_reach = 16;

struct Bands {
  std::size_t columns;
  std::size_t rows;
  std::size_t reach;
  std::size_t height = std::max(least_band_rows, band_rows_per_reach* reach);
  std::size_t count = (rows + height - 1) / height;

  std::size_t first_row(std::size_t band) const { return std::min(band * height, rows); }
  /// The rows within reach of the start of `band`, on both sides.
  std::vector<float> around_start(const std::vector<float>& plane, std::size_t band) const {
    if (band == 0) return {};
    const auto row = [&](std::size_t iy) {
      return plane.begin() + static_cast<std::ptrdiff_t>(iy * columns);
    };
    return {row(first_row(band) - reach), row(std::min(first_row(band) + reach, rows))};
  }
};

void filter(VectorField& field, const std::uint8_t* wall, int nx, int ny, double sigma_cells) {
  require(nx >= 0 && ny >= 0, "gaussian filter: sides are not negative");
  const std::vector<float> weight = kernel_of(sigma_cells);
  const Bands bands{static_cast<std::size_t>(nx), static_cast<std::size_t>(ny), weight.size() - 1};
  const std::size_t cells = bands.columns * bands.rows;
  require(field.x.size() == cells && field.y.size() == cells,
          "gaussian filter: one vector per cell");
  const std::array<std::vector<float>*, 2> planes{&field.x, &field.y};
  const std::size_t tasks = planes.size() * bands.count;
  std::vector<std::vector<float>> around(tasks);
  for_ranges(tasks, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      around[i] = bands.around_start(*planes[i / bands.count], i % bands.count);
    }
  });
  for_ranges(tasks, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t band = i % bands.count;
      const bool has_above = band + 1 < bands.count;
      filter_band(
          {.plane = planes[i / bands.count]->data(),
           .below = around[i].data(),
           .above = has_above ? around[i + 1].data() + bands.reach * bands.columns : nullptr,
           .wall = wall,
           .columns = bands.columns,
           .rows = bands.rows,
           .first_row = bands.first_row(band),
           .last_row = bands.first_row(band + 1),
           .weight = weight.data(),
           .reach = bands.reach});
    }
  });
}

}  // namespace

int gaussian_half_width(double sigma_cells) {
  require(sigma_cells > 0.0 && sigma_cells < 1.0e4, "gaussian filter: 0 < sigma_cells < 10000");
  return static_cast<int>(std::ceil(2.0 * sigma_cells));
}

void gaussian_filter(VectorField& field, int nx, int ny, double sigma_cells) {
  filter(field, nullptr, nx, ny, sigma_cells);
}

void gaussian_filter_between_walls(VectorField& field, std::span<const std::uint8_t> wall, int nx,
                                   int ny, double sigma_cells) {
  require(wall.size() == field.x.size(), "gaussian filter: one wall entry per cell");
  filter(field, wall.data(), nx, ny, sigma_cells);
}

}  // namespace fairway
