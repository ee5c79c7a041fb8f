#include "fairway/field/gaussian_filter.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"

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

constexpr std::size_t block = 256;

// sum[i] += weight * seen[i] * value[i], with seen[i] cut to 0 from the first wall on.
void add_seen(float* sum, float* seen, const float* open, const float* value, float weight,
              std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    seen[i] *= open[i];
    sum[i] += weight * (seen[i] * value[i]);
  }
}

}  // namespace

int gaussian_half_width(double sigma_cells) {
  require(sigma_cells > 0.0 && sigma_cells < 1.0e4, "gaussian filter: 0 < sigma_cells < 10000");
  return static_cast<int>(std::ceil(2.0 * sigma_cells));
}

namespace {

void filter_rows(std::vector<float>& plane, std::size_t nx, int ny,
                 const std::vector<float>& weight) {
  const std::size_t r = weight.size() - 1;
  for_rows(ny, [&](int first, int last) {
    std::vector<float> padded(nx + 2 * r, 0.0F);
    for (auto iy = static_cast<std::size_t>(first); iy < static_cast<std::size_t>(last); ++iy) {
      float* row = &plane[iy * nx];
      std::copy_n(row, nx, padded.begin() + static_cast<std::ptrdiff_t>(r));
      const float* p = padded.data() + r;
      for (std::size_t x = 0; x < nx; ++x) row[x] = weight[0] * p[x];
      for (std::size_t k = 1; k <= r; ++k) {
        const float w = weight[k];
        for (std::size_t x = 0; x < nx; ++x) row[x] += w * (p[x - k] + p[x + k]);
      }
    }
  });
}

void filter_columns(const std::vector<float>& in, std::vector<float>& out, std::size_t nx, int ny,
                    const std::vector<float>& weight) {
  const auto rows = static_cast<std::size_t>(ny);
  const std::size_t r = weight.size() - 1;
  const std::vector<float> zero(block, 0.0F);
  for_ranges((nx + block - 1) / block, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      const std::size_t x0 = b * block;
      const std::size_t n = std::min(block, nx - x0);
      for (std::size_t iy = 0; iy < rows; ++iy) {
        float* o = &out[iy * nx + x0];
        const float* c = &in[iy * nx + x0];
        for (std::size_t x = 0; x < n; ++x) o[x] = weight[0] * c[x];
        for (std::size_t k = 1; k <= r; ++k) {
          const float w = weight[k];
          const float* up = iy + k < rows ? &in[(iy + k) * nx + x0] : zero.data();
          const float* down = iy >= k ? &in[(iy - k) * nx + x0] : zero.data();
          for (std::size_t x = 0; x < n; ++x) o[x] += w * (up[x] + down[x]);
        }
      }
    }
  });
}

void filter_rows_between_walls(std::vector<float>& plane, const std::vector<float>& open,
                               std::size_t nx, int ny, const std::vector<float>& weight) {
  const std::size_t r = weight.size() - 1;
  for_rows(ny, [&](int first, int last) {
    std::vector<float> value(nx + 2 * r, 0.0F);
    std::vector<float> clear(nx + 2 * r, 0.0F);
    std::vector<float> seen(nx);
    for (auto iy = static_cast<std::size_t>(first); iy < static_cast<std::size_t>(last); ++iy) {
      float* row = &plane[iy * nx];
      const float* own = &open[iy * nx];
      for (std::size_t x = 0; x < nx; ++x) {
        value[r + x] = row[x] * own[x];
        clear[r + x] = own[x];
        row[x] = weight[0] * value[r + x];
      }
      std::copy_n(own, nx, seen.begin());
      for (std::size_t k = 1; k <= r; ++k)
        add_seen(row, seen.data(), &clear[r + k], &value[r + k], weight[k], nx);
      std::copy_n(own, nx, seen.begin());
      for (std::size_t k = 1; k <= r; ++k)
        add_seen(row, seen.data(), &clear[r - k], &value[r - k], weight[k], nx);
    }
  });
}

void filter_columns_between_walls(const std::vector<float>& in, const std::vector<float>& open,
                                  std::vector<float>& out, std::size_t nx, int ny,
                                  const std::vector<float>& weight) {
  const auto rows = static_cast<std::size_t>(ny);
  const std::size_t r = weight.size() - 1;
  for_ranges((nx + block - 1) / block, 1, [&](std::size_t first, std::size_t last) {
    std::vector<float> seen(block);
    for (std::size_t b = first; b < last; ++b) {
      const std::size_t x0 = b * block;
      const std::size_t n = std::min(block, nx - x0);
      for (std::size_t iy = 0; iy < rows; ++iy) {
        const std::size_t at = iy * nx + x0;
        for (std::size_t x = 0; x < n; ++x) out[at + x] = weight[0] * in[at + x];
        std::copy_n(&open[at], n, seen.begin());
        for (std::size_t k = 1; k <= r && iy + k < rows; ++k)
          add_seen(&out[at], seen.data(), &open[at + k * nx], &in[at + k * nx], weight[k], n);
        std::copy_n(&open[at], n, seen.begin());
        for (std::size_t k = 1; k <= r && iy >= k; ++k)
          add_seen(&out[at], seen.data(), &open[at - k * nx], &in[at - k * nx], weight[k], n);
      }
    }
  });
}

}  // namespace

void gaussian_filter(VectorField& field, int nx, int ny, double sigma_cells) {
  const std::vector<float> weight = kernel_of(sigma_cells);
  std::vector<float> other(field.x.size());
  for (std::vector<float>* plane : {&field.x, &field.y}) {
    filter_rows(*plane, static_cast<std::size_t>(nx), ny, weight);
    filter_columns(*plane, other, static_cast<std::size_t>(nx), ny, weight);
    std::swap(*plane, other);
  }
}

void gaussian_filter_between_walls(VectorField& field, std::span<const std::uint8_t> wall, int nx,
                                   int ny, double sigma_cells) {
  require(wall.size() == field.x.size(), "gaussian filter: one wall entry per cell");
  const std::vector<float> weight = kernel_of(sigma_cells);
  std::vector<float> open(wall.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = wall[i] == 0 ? 1.0F : 0.0F;
  std::vector<float> other(field.x.size());
  for (std::vector<float>* plane : {&field.x, &field.y}) {
    filter_rows_between_walls(*plane, open, static_cast<std::size_t>(nx), ny, weight);
    filter_columns_between_walls(*plane, open, other, static_cast<std::size_t>(nx), ny, weight);
    std::swap(*plane, other);
  }
}

}  // namespace fairway
