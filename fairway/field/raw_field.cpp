#include "fairway/field/raw_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "fairway/base/parallel.hpp"
#include "fairway/field/descent.hpp"
#include "fairway/field/distance_transform.hpp"
#include "fairway/field/eikonal.hpp"

namespace fairway {
namespace {

void set(VectorField& field, std::size_t i, Vec2 v) {
  const double n = norm(v);
  if (n == 0.0) return;
  field.x[i] = static_cast<float>(v.x / n);
  field.y[i] = static_cast<float>(v.y / n);
}

Vec2 between(const Grid& grid, std::size_t from, std::size_t to) {
  const Cell a = grid.cell_at(from);
  const Cell b = grid.cell_at(to);
  return {static_cast<double>(b.ix - a.ix), static_cast<double>(b.iy - a.iy)};
}

void descend_in_safe_start(const Grid& grid, const std::vector<Region>& region, Metric metric,
                           const std::vector<float>& cost, VectorField& field) {
  for_rows(grid.ny, [&](int first, int last) {
    for (int iy = first; iy < last; ++iy) {
      const DescentRows rows(cost, grid.nx, grid.ny, iy);
      for (int ix = 0; ix < grid.nx; ++ix) {
        const std::size_t i = grid.index({ix, iy});
        if (!std::isfinite(cost[i]) || region[i] == Region::buffer) continue;
        const Descent d = metric == Metric::euclidean ? descent_continuous(rows, ix)
                                                      : descent_eight(rows, ix, metric);
        field.x[i] = d.x;
        field.y[i] = d.y;
      }
    }
  });
}

// Does an obstacle lie on the straight line between two cell centres? Looked up every half cell.
bool barred(const Grid& grid, const std::vector<Region>& region, std::size_t from, std::size_t to) {
  const Cell a = grid.cell_at(from);
  const Vec2 way = between(grid, from, to);
  const int steps = static_cast<int>(2.0 * std::max(std::fabs(way.x), std::fabs(way.y)));
  for (int k = 1; k < steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    const Cell c{a.ix + static_cast<int>(std::lround(t * way.x)),
                 a.iy + static_cast<int>(std::lround(t * way.y))};
    if (region[grid.index(c)] == Region::obstacle) return true;
  }
  return false;
}

// Straight to the nearest border cell where nothing bars the way. Returns the cells where
// something does, ascending.
std::vector<std::uint32_t> leave_buffer_straight(const Grid& grid, const CompleteMap& complete,
                                                 const BufferBorder& border, bool through_walls,
                                                 std::vector<float>& cost, VectorField& field) {
  std::vector<std::vector<std::uint32_t>> barred_in_row(static_cast<std::size_t>(grid.ny));
  for_rows(grid.ny, [&](int first, int last) {
    for (int iy = first; iy < last; ++iy) {
      for (int ix = 0; ix < grid.nx; ++ix) {
        const std::size_t i = grid.index({ix, iy});
        const Region r = complete.region[i];
        const bool moves = r == Region::buffer || (through_walls && r == Region::obstacle);
        if (!moves || border.nearest[i] == no_feature) continue;
        const Vec2 way = between(grid, i, border.nearest[i]);
        const double d2 = norm2(way);
        // No obstacle centre is nearer than the border cell's: nothing can lie between.
        const bool clear = through_walls || d2 <= complete.clearance_cells2[i] ||
                           !barred(grid, complete.region, i, border.nearest[i]);
        if (!clear) {
          barred_in_row[static_cast<std::size_t>(iy)].push_back(static_cast<std::uint32_t>(i));
          continue;
        }
        set(field, i, way);
        if (r == Region::buffer)
          cost[i] = cost[border.nearest[i]] + static_cast<float>(std::sqrt(d2));
      }
    }
  });
  std::vector<std::uint32_t> out;
  for (const auto& row : barred_in_row) out.insert(out.end(), row.begin(), row.end());
  return out;
}

// The barred cells find the shortest way round: distances to the border spread into them from
// neighbouring cells that go straight.
void leave_buffer_around(const Grid& grid, const std::vector<std::uint32_t>& cells,
                         BufferBorder& border, std::vector<float>& cost, VectorField& field) {
  std::vector<std::uint8_t> inside(grid.size(), 0);
  for (const std::uint32_t i : cells) inside[i] = 1;
  std::vector<EikonalSource> sources;
  for (const std::uint32_t i : cells) {
    for_neighbours(grid, i, [&](std::uint32_t n) {
      if (inside[n] != 0 || !std::isfinite(cost[n]) ||
          field.x[n] * field.x[n] + field.y[n] * field.y[n] == 0.0F)
        return;
      inside[n] = 2;
      const double way =
          border.nearest[n] == no_feature ? 0.0 : norm(between(grid, n, border.nearest[n]));
      sources.push_back({n, static_cast<float>(way)});
    });
  }
  const std::vector<float> distance = eikonal_distance(inside, grid.nx, grid.ny, sources);
  std::vector<std::uint32_t> outward = cells;
  std::sort(outward.begin(), outward.end(), [&](std::uint32_t a, std::uint32_t b) {
    return distance[a] != distance[b] ? distance[a] < distance[b] : a < b;
  });
  for (const std::uint32_t i : outward) {
    border.nearest[i] = no_feature;
    if (!std::isfinite(distance[i])) continue;
    const Cell c = grid.cell_at(i);
    const Descent d = descent_continuous(DescentRows(distance, grid.nx, grid.ny, c.iy), c.ix);
    field.x[i] = d.x;
    field.y[i] = d.y;
    std::uint32_t before = i;
    for_neighbours(grid, i, [&](std::uint32_t n) {
      if (distance[n] < distance[before]) before = n;
    });
    border.nearest[i] = border.nearest[before];
    cost[i] = cost[before] + distance[i] - distance[before];
  }
}

void aim_at_goal(const Grid& grid, const CompleteMap& complete, const Mission& mission,
                 VectorField& field) {
  if (const auto* goal = std::get_if<GoalMission>(&mission)) {
    // The disc sees its centre: exact directions instead of the grid's.
    for (const std::uint32_t i : complete.goal_cells) {
      set(field, i, goal->goal_m - grid.center(grid.cell_at(i)));
      if (field.x[i] == 0.0F && field.y[i] == 0.0F) field.x[i] = 1.0F;  // the centre itself
    }
  } else {
    for (const PathCell& cell : complete.path_cells) set(field, cell.index, cell.tangent);
  }
}

}  // namespace

VectorField raw_field(const Grid& grid, const CompleteMap& complete, const Mission& mission,
                      Metric metric, std::vector<float>& cost_cells, BufferBorder& border) {
  VectorField field(grid.size());
  descend_in_safe_start(grid, complete.region, metric, cost_cells, field);
  aim_at_goal(grid, complete, mission, field);
  const bool paper = metric == Metric::paper;
  const std::vector<std::uint32_t> barred_cells =
      leave_buffer_straight(grid, complete, border, paper, cost_cells, field);
  if (!barred_cells.empty()) leave_buffer_around(grid, barred_cells, border, cost_cells, field);
  return field;
}

}  // namespace fairway
