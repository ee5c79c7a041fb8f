#include "fairway/ceiling/find_ceiling.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "fairway/base/error.hpp"
#include "fairway/ceiling/ceiling_level.hpp"

namespace fairway {
namespace {

CeilingCells cells_of(const Grid& grid, const std::vector<Region>& region, const Vehicle& vehicle) {
  CeilingCells cells{grid.nx, grid.ny, grid.cell_m / vehicle.turn_radius_m, {}, {}};
  for (const Region r : region) {
    cells.obstacle.push_back(r == Region::obstacle ? 1 : 0);
    cells.goal.push_back(r == Region::goal ? 1 : 0);
  }
  return cells;
}

struct Sum {
  double inside = 0.0;
  double lost = 0.0;
  double count = 0.0;

  [[nodiscard]] CeilingShare share() const {
    if (count == 0.0) return {};
    return {inside / count, 1.0 - lost / count};
  }
};

void take_level(const CeilingLevel& level, const std::vector<Region>& region, Ceiling& ceiling) {
  ceiling.headings = level.lattice.headings;
  ceiling.nodes_per_cell = level.lattice.per_cell;
  ceiling.inside = level.inside_share;
  ceiling.lost = level.lost_share;
  Sum all;
  Sum free;
  Sum buffer;
  for (std::size_t i = 0; i < ceiling.inside.size(); ++i) {
    const Region r = region[i % region.size()];
    if (r != Region::free && r != Region::buffer) continue;
    for (Sum* sum : {&all, r == Region::free ? &free : &buffer}) {
      sum->inside += static_cast<double>(ceiling.inside[i]);
      sum->lost += static_cast<double>(ceiling.lost[i]);
      sum->count += 1.0;
    }
  }
  ceiling.all = all.share();
  ceiling.free = free.share();
  ceiling.buffer = buffer.share();
}

}  // namespace

Ceiling find_ceiling(const Grid& grid, const std::vector<Region>& region, const Vehicle& vehicle,
                     const CeilingOptions& options, const CeilingProgress& progress) {
  require(region.size() == grid.size(), "a region for each cell");
  require(options.gap_max > 0.0 && options.gap_max < 1.0, "gap_max lies between 0 and 1");
  require(options.levels_max >= 1 && options.levels_max <= 5, "levels_max is 1 to 5");
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  const auto stop = [&] {
    return std::chrono::duration<double>(Clock::now() - begun).count() > options.time_limit_s ||
           (progress.stop && progress.stop());
  };
  const CeilingCells cells = cells_of(grid, region, vehicle);
  Ceiling ceiling;
  ceiling.grid = grid;
  ceiling.vehicle = vehicle;
  std::optional<CeilingLevel> coarse;
  double bytes_before = 0.0;
  for (int level = 0; level < options.levels_max; ++level) {
    const auto bytes = static_cast<double>(bytes_of_level(cells, level));
    if (bytes + bytes_before > options.memory_limit_mb * 1e6) ceiling.complete = false;
    if (!ceiling.complete) break;
    bytes_before = bytes;
    auto found = ceiling_level(cells, level, coarse ? &*coarse : nullptr, stop);
    if (!found) ceiling.complete = false;
    if (!ceiling.complete) break;
    take_level(*found, region, ceiling);
    ceiling.levels = level + 1;
    if (progress.level) progress.level(ceiling.all, ceiling.levels);
    if (ceiling.all.upper - ceiling.all.lower <= options.gap_max) break;
    coarse = std::move(found);
  }
  return ceiling;
}

}  // namespace fairway
