#include "fairway/run/stratified_states.hpp"

#include <algorithm>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

/// The bits of x in the even places, those of y in the odd ones: near numbers are near places.
std::uint64_t z_order(std::uint32_t x, std::uint32_t y) {
  const auto spread = [](std::uint64_t v) {
    v = (v | (v << 16)) & 0x0000ffff0000ffffULL;
    v = (v | (v << 8)) & 0x00ff00ff00ff00ffULL;
    v = (v | (v << 4)) & 0x0f0f0f0f0f0f0f0fULL;
    v = (v | (v << 2)) & 0x3333333333333333ULL;
    return (v | (v << 1)) & 0x5555555555555555ULL;
  };
  return spread(x) | (spread(y) << 1);
}

}  // namespace

std::vector<State> stratified_states(const Grid& grid, const std::vector<bool>& ground,
                                     std::size_t strata, std::uint64_t seed) {
  require(ground.size() == grid.size(), "the ground is that of the grid");
  std::vector<std::pair<std::uint64_t, std::size_t>> cells;
  for (std::size_t i = 0; i < ground.size(); ++i) {
    if (!ground[i]) continue;
    const Cell c = grid.cell_at(i);
    cells.emplace_back(z_order(static_cast<std::uint32_t>(c.ix), static_cast<std::uint32_t>(c.iy)),
                       i);
  }
  std::vector<State> states;
  if (cells.empty()) return states;
  std::sort(cells.begin(), cells.end());
  states.reserve(2 * strata);
  const auto all = static_cast<double>(cells.size());
  for (std::size_t k = 0; k < strata; ++k) {
    Random random = Random::stream(seed, k);
    for (int twice = 0; twice < 2; ++twice) {
      const double along =
          (static_cast<double>(k) + random.unit()) * all / static_cast<double>(strata);
      const std::size_t cell = std::min(static_cast<std::size_t>(along), cells.size() - 1);
      const Vec2 corner = grid.corner(grid.cell_at(cells[cell].second));
      const double x = corner.x + grid.cell_m * random.unit();
      const double y = corner.y + grid.cell_m * random.unit();
      states.push_back({{x, y}, Heading::from_rad(random.uniform(-pi, pi))});
    }
  }
  return states;
}

}  // namespace fairway
