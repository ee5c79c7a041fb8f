#include "fairway/report/cell_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

Color color_of_cell(const Plan& plan, std::size_t i, bool cost, double largest_m) {
  switch (plan.region[i]) {
    case Region::obstacle:
      return palette::obstacle;
    case Region::buffer:
      return palette::buffer;
    case Region::goal:
      return palette::goal;
    case Region::free:
      break;
  }
  if (is_unreachable(plan, i)) return palette::unreachable;
  if (!cost) return palette::free;
  return cost_ramp(largest_m > 0.0 ? plan.cost_m[i] / largest_m : 0.0);
}

}  // namespace

bool is_unreachable(const Plan& plan, std::size_t cell) {
  return plan.region[cell] == Region::free && !std::isfinite(plan.cost_m[cell]);
}

double largest_cost_m(const Plan& plan) {
  double largest = 0.0;
  for (std::size_t i = 0; i < plan.cost_m.size(); ++i)
    if (plan.region[i] == Region::free && std::isfinite(plan.cost_m[i]))
      largest = std::max(largest, static_cast<double>(plan.cost_m[i]));
  return largest;
}

CellLayer cell_layer(const Plan& plan, bool cost, int most_pixels) {
  require(most_pixels >= 1, "a cell layer has at least one pixel");
  const Grid& grid = plan.grid;
  CellLayer layer;
  layer.cells_per_pixel = std::max(1, (std::max(grid.nx, grid.ny) + most_pixels - 1) / most_pixels);
  const int k = layer.cells_per_pixel;
  Raster& raster = layer.raster;
  raster.width = (grid.nx + k - 1) / k;
  raster.height = (grid.ny + k - 1) / k;
  raster.pixels.resize(static_cast<std::size_t>(raster.width) *
                       static_cast<std::size_t>(raster.height));
  const double largest_m = largest_cost_m(plan);
  for_rows(raster.height, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      const int iy0 = (raster.height - 1 - row) * k;
      for (int column = 0; column < raster.width; ++column) {
        std::array<long, 3> sum{};
        long count = 0;
        for (int iy = iy0; iy < std::min(grid.ny, iy0 + k); ++iy)
          for (int ix = column * k; ix < std::min(grid.nx, (column + 1) * k); ++ix) {
            const Color c = color_of_cell(plan, grid.index({ix, iy}), cost, largest_m);
            sum[0] += c.red;
            sum[1] += c.green;
            sum[2] += c.blue;
            ++count;
          }
        const auto mean = [&](long s) {
          return static_cast<std::uint8_t>((s + count / 2) / count);
        };
        raster.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(raster.width) +
                      static_cast<std::size_t>(column)] = {mean(sum[0]), mean(sum[1]),
                                                           mean(sum[2])};
      }
    }
  });
  return layer;
}

}  // namespace fairway
