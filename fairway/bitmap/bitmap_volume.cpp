#include "fairway/bitmap/bitmap_volume.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"

namespace fairway {

BitmapLookup::BitmapLookup(const Plan& plan, const std::vector<std::uint8_t>& target_cells,
                           const BorderBitmap& set)
    : plan_(plan), target_cells_(target_cells), set_(set), samples_(set.samples) {
  require(set.grid == plan.grid, "the bitmap is of the plan's grid");
  require(target_cells.size() == plan.grid.size() && plan.region.size() == plan.grid.size() &&
              plan.heading_rad.size() == plan.grid.size(),
          "a plan's arrays and the region have one entry per cell");
  require(plan.grid.cell_m > 0.0 && plan.grid.cell_m < plan.vehicle.turn_radius_m,
          "0 < cell side < turning radius");
  require(set.words.size() == set.borders().count() * set.words_per_border(),
          "the bitmap is as large as its borders ask");
}

bool BitmapLookup::reaches(const State& state) const {
  const Grid& grid = plan_.grid;
  const Vec2 p{state.position_m.x - grid.x0_m, state.position_m.y - grid.y0_m};
  if (!(p.x >= 0.0 && p.x <= grid.width_m() && p.y >= 0.0 && p.y <= grid.height_m())) return false;
  const double d = grid.cell_m;
  const Cell cell{std::min(static_cast<int>(p.x / d), grid.nx - 1),
                  std::min(static_cast<int>(p.y / d), grid.ny - 1)};
  const std::size_t place = grid.index(cell);
  if (target_cells_[place] != 0) return true;
  if (plan_.region[place] == Region::obstacle) return false;
  const double command_rad = plan_.heading_rad[place];
  const Direction command =
      std::isnan(command_rad) ? Direction::none() : Direction::of(Heading::from_rad(command_rad));
  const Vec2 inside{std::clamp(p.x - cell.ix * d, 0.0, d), std::clamp(p.y - cell.iy * d, 0.0, d)};
  const CellExit exit =
      cross_cell({inside, Direction::of(state.heading)}, command, {d, plan_.vehicle.turn_radius_m});
  const BorderNumbers borders = set_.borders();
  if (!borders.is_inner(cell, exit.side)) return false;
  const bool upright = exit.side == Side::right || exit.side == Side::left;
  const Vec2 q = exit.state.position_m;
  return set_.reached(borders.of(cell, exit.side), samples_.heading_bin(exit.state.heading.unit),
                      samples_.position_bin((upright ? q.y : q.x) / d));
}

VolumeShare volume_share_reached(const Plan& plan, const std::vector<std::uint8_t>& target_cells,
                                 const BorderBitmap& set, std::size_t draws, std::uint64_t seed) {
  const BitmapLookup lookup(plan, target_cells, set);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < plan.grid.size(); ++i)
    if (target_cells[i] == 0 && plan.region[i] != Region::obstacle) open.push_back(i);
  VolumeShare share;
  if (open.empty() || draws == 0) return share;
  std::atomic<std::size_t> reached{0};
  for_ranges(draws, 4096, [&](std::size_t begin, std::size_t end) {
    std::size_t here = 0;
    for (std::size_t draw = begin; draw < end; ++draw) {
      Random random = Random::stream(seed, draw);
      const Cell cell = plan.grid.cell_at(open[random.below(open.size())]);
      const Vec2 corner = plan.grid.corner(cell);
      const Vec2 p{corner.x + plan.grid.cell_m * random.unit(),
                   corner.y + plan.grid.cell_m * random.unit()};
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
