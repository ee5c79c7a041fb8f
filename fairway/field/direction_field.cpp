#include "fairway/field/direction_field.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/field/wall_bend.hpp"

namespace fairway {

std::vector<float> direction_field(const Grid& grid, const std::vector<Region>& region,
                                   double direction_rad, double reach_m) {
  VectorField onwards(grid.size());
  std::fill(onwards.x.begin(), onwards.x.end(), static_cast<float>(std::cos(direction_rad)));
  std::fill(onwards.y.begin(), onwards.y.end(), static_cast<float>(std::sin(direction_rad)));
  return bent_along_walls(grid, region, onwards, reach_m);
}

}  // namespace fairway
