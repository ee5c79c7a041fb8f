#include "fairway/field/turning_field.hpp"

#include <cmath>

#include "fairway/base/parallel.hpp"
#include "fairway/field/descent.hpp"
#include "fairway/field/eikonal.hpp"
#include "fairway/field/wall_bend.hpp"

namespace fairway {

std::vector<float> turning_field(const Grid& grid, const std::vector<Region>& region,
                                 std::span<const std::uint8_t> places, double reach_m) {
  std::vector<std::uint8_t> inside(grid.size());
  std::vector<EikonalSource> sources;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    inside[i] = region[i] == Region::obstacle ? 0 : 1;
    if (places[i] != 0) sources.push_back({static_cast<std::uint32_t>(i), 0.0F});
  }
  const std::vector<float> distance = eikonal_distance(inside, grid.nx, grid.ny, sources);
  VectorField onwards(grid.size());
  for_rows(grid.ny, [&](int first, int last) {
    for (int iy = first; iy < last; ++iy) {
      const DescentRows rows(distance, grid.nx, grid.ny, iy);
      for (int ix = 0; ix < grid.nx; ++ix) {
        const std::size_t i = grid.index({ix, iy});
        if (!std::isfinite(distance[i]) || distance[i] == 0.0F) continue;
        const Descent down = descent_continuous(rows, ix);
        onwards.x[i] = down.x;
        onwards.y[i] = down.y;
      }
    }
  });
  return bent_along_walls(grid, region, onwards, reach_m);
}

}  // namespace fairway
