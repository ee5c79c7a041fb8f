#include "fairway/field/wall_bend.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fairway/base/parallel.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/field/distance_transform.hpp"
#include "fairway/field/gaussian_filter.hpp"
#include "fairway/field/stored_command.hpp"

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

std::vector<float> bent_along_walls(const Grid& grid, const std::vector<Region>& region,
                                    const VectorField& onwards, double reach_m) {
  constexpr double push_at_wall = 1.8;
  constexpr double sigma_cells = 1.0;
  constexpr double capture_rad = 0.02;  // as FieldOptions::axis_capture_rad
  std::vector<std::uint8_t> wall(grid.size());
  for (std::size_t i = 0; i < wall.size(); ++i) wall[i] = region[i] == Region::obstacle ? 1 : 0;
  const std::vector<double> clearance = clearance_m(grid, wall);
  const auto at = [&](Cell c) { return grid.contains(c) ? clearance[grid.index(c)] : 0.0; };
  VectorField field(grid.size());
  for_ranges(grid.size(), 4096, [&](std::size_t a, std::size_t b) {
    for (std::size_t i = a; i < b; ++i) {
      if (wall[i] != 0) continue;
      const Vec2 u{static_cast<double>(onwards.x[i]), static_cast<double>(onwards.y[i])};
      if (u == Vec2{}) continue;
      const Cell c = grid.cell_at(i);
      const Vec2 away{(at({c.ix + 1, c.iy}) - at({c.ix - 1, c.iy})) / (2.0 * grid.cell_m),
                      (at({c.ix, c.iy + 1}) - at({c.ix, c.iy - 1})) / (2.0 * grid.cell_m)};
      const double push = push_at_wall * std::max(0.0, 1.0 - clearance[i] / reach_m);
      const Vec2 v = u + push * away;
      const double length = norm(v);
      const Vec2 unit = length < 1e-9 ? u : (1.0 / length) * v;
      field.x[i] = static_cast<float>(unit.x);
      field.y[i] = static_cast<float>(unit.y);
    }
  });
  gaussian_filter_between_walls(field, wall, grid.nx, grid.ny, sigma_cells);
  std::vector<float> heading_rad(grid.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < wall.size(); ++i) {
    const bool none = onwards.x[i] == 0.0F && onwards.y[i] == 0.0F;
    if (wall[i] != 0 || none) continue;
    const bool vanished = has_vanished(field.x[i], field.y[i]);
    heading_rad[i] = stored_command(vanished ? onwards.x[i] : field.x[i],
                                    vanished ? onwards.y[i] : field.y[i], capture_rad);
  }
  return heading_rad;
}

}  // namespace fairway
