#include "fairway/bitmap/bitmap_volume.hpp"

#include <atomic>
#include <cmath>

#include "fairway/base/heading.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"

namespace fairway {

VolumeShare volume_share_reached(const Plan& plan, const std::vector<std::uint8_t>& target_cells,
                                 const BorderBitmap& set, std::size_t draws, std::uint64_t seed) {
  return volume_share_reached(BitmapLookup(plan, target_cells, set), draws, seed);
}

VolumeShare volume_share_reached(const BitmapLookup& lookup, std::size_t draws,
                                 std::uint64_t seed) {
  const Grid& grid = lookup.grid();
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (lookup.kind_at(i) == CellKind::ordinary) open.push_back(i);
  VolumeShare share;
  if (open.empty() || draws == 0) return share;
  std::atomic<std::size_t> reached{0};
  for_ranges(draws, 4096, [&](std::size_t begin, std::size_t end) {
    std::size_t here = 0;
    for (std::size_t draw = begin; draw < end; ++draw) {
      Random random = Random::stream(seed, draw);
      const Cell cell = grid.cell_at(open[random.below(open.size())]);
      const Vec2 corner = grid.corner(cell);
      const Vec2 p{corner.x + grid.cell_m * random.unit(), corner.y + grid.cell_m * random.unit()};
      here += lookup.reaches({p, Heading::from_rad(random.uniform(-pi, pi))}) ? 1 : 0;
    }
    reached += here;
  });
  const auto n = static_cast<double>(draws);
  share.draws = draws;
  share.reached = static_cast<double>(reached.load()) / n;
  share.standard_error = std::sqrt(share.reached * (1.0 - share.reached) / n);
  return share;
}

}  // namespace fairway
