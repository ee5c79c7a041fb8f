#include "fairway/compare/common_ground.hpp"

#include <algorithm>
#include <tuple>

#include "fairway/run/stratified_states.hpp"

namespace fairway {
namespace {

bool is_ordinary(Region region) { return region == Region::free || region == Region::buffer; }

auto order_of(const ComparedPlan& p) {
  const Grid& g = p.plan.grid;
  return std::tuple(g.cell_m, g.x0_m, g.y0_m, g.nx, g.ny);
}

}  // namespace

bool is_on_ground(const Plan& plan, Vec2 place_m) {
  const Cell c = plan.grid.cell_of(place_m);
  return plan.grid.contains(c) && is_ordinary(plan.region[plan.grid.index(c)]);
}

CommonGround common_ground(std::span<const ComparedPlan> plans, std::size_t strata,
                           std::uint64_t seed) {
  CommonGround ground;
  ground.grid = std::min_element(plans.begin(), plans.end(),
                                 [](const ComparedPlan& a, const ComparedPlan& b) {
                                   return order_of(a) < order_of(b);
                                 })
                    ->plan.grid;
  ground.cells.assign(ground.grid.size(), true);
  bool one_grid = true;
  for (const ComparedPlan& p : plans) {
    if (p.plan.grid != ground.grid) {
      one_grid = false;
      continue;
    }
    for (std::size_t i = 0; i < ground.cells.size(); ++i) {
      ground.cells[i] = ground.cells[i] && is_ordinary(p.plan.region[i]);
    }
  }
  ground.states = stratified_states(ground.grid, ground.cells, strata, seed);
  ground.counted = ground.states.size();
  if (one_grid) return ground;
  ground.counts.resize(ground.states.size());
  for (std::size_t i = 0; i < ground.states.size(); ++i) {
    ground.counts[i] = std::all_of(plans.begin(), plans.end(), [&](const ComparedPlan& p) {
      return is_on_ground(p.plan, ground.states[i].position_m);
    });
  }
  ground.counted =
      static_cast<std::size_t>(std::count(ground.counts.begin(), ground.counts.end(), true));
  return ground;
}

}  // namespace fairway
