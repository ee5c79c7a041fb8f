#include "reproduce/buffer_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fairway::reproduce {
namespace {

/// From any point of one cell to any of another, a number of columns and rows away.
double least_between_m(int dx, int dy, double cell_m) {
  const auto gap = [](int d) { return static_cast<double>(std::max(std::abs(d) - 1, 0)); };
  return cell_m * std::hypot(gap(dx), gap(dy));
}

}  // namespace

BufferMeasures buffer_measures(const Grid& grid, const std::vector<Region>& region,
                               double width_m) {
  const int reach = static_cast<int>(std::ceil(width_m / grid.cell_m)) + 2;
  BufferMeasures found;
  found.least_m = std::numeric_limits<double>::infinity();
  std::size_t safe = 0;
  std::size_t within = 0;
  for (std::size_t i = 0; i < region.size(); ++i) {
    if (region[i] != Region::free && region[i] != Region::goal) continue;
    ++safe;
    const Cell c = grid.cell_at(i);
    double least_m = std::numeric_limits<double>::infinity();
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const Cell other{c.ix + dx, c.iy + dy};
        if (!grid.contains(other) || region[grid.index(other)] != Region::obstacle) continue;
        least_m = std::min(least_m, least_between_m(dx, dy, grid.cell_m));
      }
    }
    found.least_m = std::min(found.least_m, least_m);
    within += least_m < width_m ? 1 : 0;
  }
  found.share = safe == 0 ? 0.0 : static_cast<double>(within) / static_cast<double>(safe);
  return found;
}

}  // namespace fairway::reproduce
