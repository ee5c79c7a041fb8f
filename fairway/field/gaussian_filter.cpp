#include "fairway/field/gaussian_filter.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/field/gaussian_strip.hpp"

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

void filter(VectorField& field, const std::uint8_t* wall, int nx, int ny, double sigma_cells) {
  require(nx >= 0 && ny >= 0, "gaussian filter: sides are not negative");
  const auto columns = static_cast<std::size_t>(nx);
  const auto rows = static_cast<std::size_t>(ny);
  require(field.x.size() == columns * rows && field.y.size() == columns * rows,
          "gaussian filter: one vector per cell");
  const std::vector<float> weight = kernel_of(sigma_cells);
  std::vector<float> filtered(columns * rows);
  for (std::vector<float>* plane : {&field.x, &field.y}) {
    // Pieces of a strip are cut at fixed rows: what is computed never depends on the threads.
    const std::size_t strips = (columns + gaussian_strip_width - 1) / gaussian_strip_width;
    const std::size_t pieces = (rows + gaussian_piece_rows - 1) / gaussian_piece_rows;
    for_ranges(strips * pieces, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        filter_strip(
            {plane->data(), wall, filtered.data(), columns, rows, weight.data(), weight.size() - 1},
            i / pieces * gaussian_strip_width, i % pieces * gaussian_piece_rows);
      }
    });
    std::swap(*plane, filtered);
  }
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
