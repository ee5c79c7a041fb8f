// For tests: small plans made by hand.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway::testing {

/// Every cell free, its cost and heading given by functions of its centre.
template <typename Cost, typename Angle>
Plan plan_of(const Grid& grid, const Cost& cost_m, const Angle& heading_rad) {
  Plan plan;
  plan.grid = grid;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Vec2 p = grid.center(grid.cell_at(i));
    plan.region.push_back(Region::free);
    plan.cost_m.push_back(static_cast<float>(cost_m(p)));
    plan.heading_rad.push_back(Heading::stored(heading_rad(p)));
  }
  return plan;
}

/// A plan towards `goal`, with a goal square of 3 x 3 cells, and an obstacle of 5 x 5 cells with a
/// buffer of one cell about `rock`.
inline Plan island_plan(const Grid& grid, Vec2 goal, Cell rock) {
  Plan plan = plan_of(
      grid, [&](Vec2 p) { return norm(goal - p); },
      [&](Vec2 p) { return std::atan2(goal.y - p.y, goal.x - p.x); });
  const Cell at = grid.cell_of(goal);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Cell c = grid.cell_at(i);
    const int from_goal = std::max(std::abs(c.ix - at.ix), std::abs(c.iy - at.iy));
    const int from_rock = std::max(std::abs(c.ix - rock.ix), std::abs(c.iy - rock.iy));
    if (from_goal <= 1) plan.region[i] = Region::goal;
    if (from_rock == 3) plan.region[i] = Region::buffer;
    if (from_rock <= 2) {
      plan.region[i] = Region::obstacle;
      plan.cost_m[i] = std::numeric_limits<float>::infinity();
      plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return plan;
}

/// Anything a plan may hold, of any small size, drawn cell by cell.
inline Plan wild_plan(Random& random) {
  Plan plan;
  plan.grid = {static_cast<int>(random.below(9)), static_cast<int>(random.below(9)),
               random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4), random.uniform(0.1, 50.0)};
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    plan.region.push_back(static_cast<Region>(static_cast<int>(random.below(4)) - 1));
    plan.cost_m.push_back(random.below(3) == 0 ? std::numeric_limits<float>::infinity()
                                               : static_cast<float>(random.uniform(0.0, 1e4)));
    plan.heading_rad.push_back(random.below(3) == 0 ? std::numeric_limits<float>::quiet_NaN()
                                                    : Heading::stored(random.uniform(-pi, pi)));
  }
  return plan;
}

}  // namespace fairway::testing
