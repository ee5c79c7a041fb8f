#include "fairway/simulate/start_states.hpp"

#include <cmath>

#include "fairway/base/random.hpp"

namespace fairway {

namespace {

bool belongs(const Plan& plan, std::size_t cell, StartRegion where) {
  const Region region = plan.region[cell];
  switch (where) {
    case StartRegion::safe_start:
      return region == Region::free && std::isfinite(plan.cost_m[cell]);
    case StartRegion::flyable:
      return region == Region::free || region == Region::buffer;
    case StartRegion::not_obstacle:
      return region != Region::obstacle;
  }
  return false;
}

}  // namespace

std::vector<State> random_states(const Plan& plan, StartRegion where, std::size_t count,
                                 std::uint64_t seed) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    if (belongs(plan, i, where)) cells.push_back(i);
  }
  std::vector<State> states;
  if (cells.empty()) return states;
  states.reserve(count);
  const double d = plan.grid.cell_m;
  for (std::size_t i = 0; i < count; ++i) {
    Random random = Random::stream(seed, i);
    const Vec2 corner = plan.grid.corner(plan.grid.cell_at(cells[random.below(cells.size())]));
    const double x = corner.x + d * random.unit();
    const double y = corner.y + d * random.unit();
    states.push_back({{x, y}, Heading::from_rad(random.uniform(-pi, pi))});
  }
  return states;
}

}  // namespace fairway
