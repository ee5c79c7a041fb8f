#include "fairway/field/cost_to_go.hpp"

#include <algorithm>

#include "fairway/base/parallel.hpp"
#include "fairway/field/eikonal.hpp"
#include "fairway/field/mission_cells.hpp"
#include "fairway/field/octile.hpp"

namespace fairway {
namespace {

std::vector<std::uint8_t> safe_start(const CompleteMap& complete) {
  std::vector<std::uint8_t> inside(complete.region.size());
  for_ranges(inside.size(), 1 << 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      inside[i] = complete.region[i] == Region::free || complete.region[i] == Region::goal ? 1 : 0;
    }
  });
  return inside;
}

// Exact distances where the mission gives them: to the centre in the goal disc, to the path in a
// path's cells and their neighbours. Without the neighbours, a cell right next to the path would
// measure to the centre of a path cell, up to a cell too far, and the field next to a slanted path
// would waver.
std::vector<EikonalSource> exact_sources(const Grid& grid, const CompleteMap& complete,
                                         const Mission& mission) {
  std::vector<EikonalSource> sources;
  if (const auto* goal = std::get_if<GoalMission>(&mission)) {
    for (const std::uint32_t i : complete.goal_cells) {
      const double distance_m = norm(grid.center(grid.cell_at(i)) - goal->goal_m);
      sources.push_back({i, static_cast<float>(distance_m / grid.cell_m)});
    }
  } else {
    for (const PathCell& cell : cells_near_path(grid, std::get<PathMission>(mission))) {
      sources.push_back({cell.index, static_cast<float>(cell.distance_m / grid.cell_m)});
    }
  }
  return sources;
}

// Where Algorithm 2 starts: the one cell of a goal, or every cell of a path.
std::vector<std::uint32_t> cell_sources(const Grid& grid, const CompleteMap& complete,
                                        const Mission& mission) {
  const auto* goal = std::get_if<GoalMission>(&mission);
  if (goal == nullptr) return complete.goal_cells;
  const Cell cell = grid.cell_of(goal->goal_m);
  return {static_cast<std::uint32_t>(
      grid.index({std::min(cell.ix, grid.nx - 1), std::min(cell.iy, grid.ny - 1)}))};
}

}  // namespace

std::vector<float> cost_to_go(const Grid& grid, const CompleteMap& complete, const Mission& mission,
                              Metric metric) {
  const std::vector<std::uint8_t> inside = safe_start(complete);
  switch (metric) {
    case Metric::euclidean:
      return eikonal_distance(inside, grid.nx, grid.ny, exact_sources(grid, complete, mission));
    case Metric::octile:
      return octile_distance(inside, grid.nx, grid.ny, cell_sources(grid, complete, mission));
    case Metric::paper: {
      std::vector<float> cost =
          paper_wavefront(inside, grid.nx, grid.ny, cell_sources(grid, complete, mission), 2.0F, 0);
      for (float& c : cost) c -= 2.0F;
      return cost;
    }
  }
  return {};
}

}  // namespace fairway
