#include "fairway/field/buffer_rule.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "fairway/field/distance_transform.hpp"

namespace fairway {
namespace {

// Distances to the nearest obstacle in the metric whose circles are squares, in cells: the amount
// by which Algorithm 1 widens obstacles, since a sweep reaches all eight neighbours. Two passes are
// exact for it (Rosenfeld and Pfaltz 1968).
std::vector<std::int32_t> square_distances(const ObstacleMap& map) {
  const Grid& g = map.grid;
  const std::int32_t beyond = std::max(g.nx, g.ny);
  std::vector<std::int32_t> distance(g.size(), beyond);
  const auto lower = [&](Cell c, std::initializer_list<Cell> steps) {
    std::int32_t& here = distance[g.index(c)];
    if (map.obstacle[g.index(c)] != 0) here = 0;
    for (const Cell step : steps) {
      const Cell n{c.ix + step.ix, c.iy + step.iy};
      if (g.contains(n)) here = std::min(here, distance[g.index(n)] + 1);
    }
  };
  for (int iy = 0; iy < g.ny; ++iy) {
    for (int ix = 0; ix < g.nx; ++ix) lower({ix, iy}, {{-1, 0}, {-1, -1}, {0, -1}, {1, -1}});
  }
  for (int iy = g.ny - 1; iy >= 0; --iy) {
    for (int ix = g.nx - 1; ix >= 0; --ix) lower({ix, iy}, {{1, 0}, {1, 1}, {0, 1}, {-1, 1}});
  }
  for (std::int32_t& d : distance) {
    if (d == beyond) d = no_feature_distance;  // there is no obstacle
  }
  return distance;
}

}  // namespace

double Clearances::clearance_m(std::size_t index) const {
  const std::int32_t m = measure[index];
  if (m == no_feature_distance) return std::numeric_limits<double>::infinity();
  return (metric == Metric::paper ? m : std::sqrt(static_cast<double>(m))) * grid.cell_m;
}

double Clearances::free_width_m(std::size_t index) const {
  const double width_m = clearance_m(index);
  return metric == Metric::paper ? std::max(width_m - grid.cell_m, 0.0) : width_m;
}

Clearances clearances(const ObstacleMap& map, Metric metric) {
  Clearances out{map.grid, metric, {}};
  if (metric == Metric::paper) {
    out.measure = square_distances(map);
    return out;
  }
  out.measure.resize(map.grid.size());
  distance_transform(map.obstacle, map.grid.nx, map.grid.ny, {out.measure, {}});
  return out;
}

int paper_sweeps(const Grid& grid, double width_m) {
  const double width_cells = std::ceil(width_m / grid.cell_m - 1e-9);
  return static_cast<int>(std::clamp(width_cells, 1.0, 1.0 * std::max(grid.nx, grid.ny)));
}

// The added 1e-9 keeps a distance of exactly alpha * r inside when the quotient is rounded down.
// Below the mark for "no obstacle".
double buffer_limit(const Grid& grid, Metric metric, double width_m) {
  if (metric == Metric::paper) return paper_sweeps(grid, width_m);
  const double cells = width_m / grid.cell_m;
  return std::min(cells * cells * (1.0 + 1e-9), no_feature_distance - 1.0);
}

}  // namespace fairway
