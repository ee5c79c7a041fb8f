#include "bench/distance_problem.hpp"

#include <cmath>
#include <cstddef>

#include "fairway/field/eikonal.hpp"

namespace fairway::bench {

std::vector<float> eikonal_answer(const DistanceProblem& problem) {
  std::vector<std::uint8_t> inside(problem.blocked.size());
  for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = problem.blocked[i] == 0 ? 1 : 0;
  std::vector<EikonalSource> sources;
  const int reach = static_cast<int>(problem.radius_cells);
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double distance = std::hypot(dx, dy);
      const Cell c{problem.goal.ix + dx, problem.goal.iy + dy};
      const Grid grid{problem.nx, problem.ny};
      if (distance > problem.radius_cells || !grid.contains(c)) continue;
      sources.push_back({static_cast<std::uint32_t>(grid.index(c)), static_cast<float>(distance)});
    }
  }
  return eikonal_distance(inside, problem.nx, problem.ny, sources);
}

}  // namespace fairway::bench
