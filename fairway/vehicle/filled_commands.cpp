#include "fairway/vehicle/filled_commands.hpp"

#include <cmath>
#include <cstddef>

#include "fairway/base/parallel.hpp"
#include "fairway/vehicle/nearest_command.hpp"

namespace fairway {

std::vector<float> filled_commands(const Grid& grid, const float* heading_rad) {
  std::vector<int> row(grid.size());
  find_nearest_rows(grid, heading_rad, row.data());
  std::vector<float> filled(heading_rad, heading_rad + grid.size());
  for_ranges(grid.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!std::isnan(filled[i])) continue;
      const std::size_t nearest = cell_in_command(grid, row.data(), grid.cell_at(i));
      if (nearest < grid.size()) filled[i] = heading_rad[nearest];
    }
  });
  return filled;
}

}  // namespace fairway
