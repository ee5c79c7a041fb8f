#include "fairway/field/direction_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fairway/base/parallel.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/field/distance_transform.hpp"
#include "fairway/field/gaussian_filter.hpp"
#include "fairway/field/stored_command.hpp"
#include "fairway/field/vector_field.hpp"

namespace fairway {
namespace {

/// Metres to the nearest obstacle cell, centre to centre; cells beyond the grid count.
std::vector<double> clearance_m(const Grid& grid, const std::vector<std::uint8_t>& wall) {
  std::vector<std::int32_t> squared(grid.size());
  distance_transform(wall, grid.nx, grid.ny, {squared, {}});
  std::vector<double> clearance(grid.size());
  for (std::size_t i = 0; i < clearance.size(); ++i) {
    const Cell c = grid.cell_at(i);
    const int rim = std::min({c.ix + 1, c.iy + 1, grid.nx - c.ix, grid.ny - c.iy});
    const double cells =
        std::min(std::sqrt(static_cast<double>(squared[i])), static_cast<double>(rim));
    clearance[i] = grid.cell_m * cells;
  }
  return clearance;
}

}  // namespace

std::vector<float> direction_field(const Grid& grid, const std::vector<Region>& region,
                                   double direction_rad, double reach_m) {
  std::vector<std::uint8_t> wall(grid.size());
  for (std::size_t i = 0; i < wall.size(); ++i) wall[i] = region[i] == Region::obstacle ? 1 : 0;
  const std::vector<double> clearance = clearance_m(grid, wall);
  const Vec2 onwards{std::cos(direction_rad), std::sin(direction_rad)};
  VectorField field(grid.size());
  const auto at = [&](Cell c) { return grid.contains(c) ? clearance[grid.index(c)] : 0.0; };
  for_ranges(grid.size(), 4096, [&](std::size_t a, std::size_t b) {
    for (std::size_t i = a; i < b; ++i) {
      if (wall[i] != 0) continue;
      const Cell c = grid.cell_at(i);
      const Vec2 slope{(at({c.ix + 1, c.iy}) - at({c.ix - 1, c.iy})) / (2.0 * grid.cell_m),
                       (at({c.ix, c.iy + 1}) - at({c.ix, c.iy - 1})) / (2.0 * grid.cell_m)};
      const double push = 1.5 * std::max(0.0, 1.2 - clearance[i] / reach_m * 1.2);
      const Vec2 v = onwards + push * slope;
      const double length = std::hypot(v.x, v.y);
      if (length < 1e-9) continue;
      field.x[i] = static_cast<float>(v.x / length);
      field.y[i] = static_cast<float>(v.y / length);
    }
  });
  gaussian_filter_between_walls(field, wall, grid.nx, grid.ny, 1.0);
  std::vector<float> heading_rad(grid.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < wall.size(); ++i) {
    if (wall[i] != 0) continue;
    const bool none = has_vanished(field.x[i], field.y[i]);
    heading_rad[i] =
        none ? stored_command(static_cast<float>(onwards.x), static_cast<float>(onwards.y), 0.02)
             : stored_command(field.x[i], field.y[i], 0.02);
  }
  return heading_rad;
}

}  // namespace fairway
