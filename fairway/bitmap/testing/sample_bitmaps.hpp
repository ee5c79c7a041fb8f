// Plans with goal, obstacles and a random swirl, and bitmaps of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "fairway/base/random.hpp"
#include "fairway/bitmap/bitmap.hpp"
#include "fairway/bitmap/bitmap_backward.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

/// Towards a goal near the middle, turned aside by a smooth random swirl; a few obstacle cells, a
/// cell without command; away from (0, 0) on purpose.
inline Plan swirled_plan(int n, Random& random) {
  Plan plan;
  plan.grid = {n, n + 3, -35.0, 12.0, 8.0};
  plan.vehicle = {10.0, 8.0 * random.uniform(1.2, 4.0)};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  const Vec2 goal = plan.grid.corner({n / 2, n / 2});
  const double swirl = random.uniform(-1.0, 1.0);
  const double wave = random.uniform(0.1, 0.8);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    const Vec2 to_goal = goal - plan.grid.center(c);
    plan.heading_rad.push_back(Heading::stored(std::atan2(to_goal.y, to_goal.x) +
                                               swirl * std::sin(wave * c.ix + 0.3 * c.iy)));
    if (random.below(40) == 0) plan.region[i] = Region::obstacle;
    if (norm(to_goal) < 40.0) plan.region[i] = Region::goal;
  }
  plan.heading_rad.front() = std::numeric_limits<float>::quiet_NaN();
  plan.cost_m.front() = std::numeric_limits<float>::infinity();
  return plan;
}

inline Bitmap bitmap_of(const Plan& plan, const RegionOfInterest& interest, int samples) {
  Bitmap bitmap;
  bitmap.vehicle = plan.vehicle;
  bitmap.region_of_interest = interest;
  bitmap.heading_rad = plan.heading_rad;
  bitmap.region = plan.region;
  bitmap.kind = cell_kinds(plan.grid, plan.region, interest);
  bitmap.set =
      backward_reachable_set(plan, target_cells(plan.grid, plan.region, interest), {samples});
  bitmap.plan = plan_digests(plan);
  return bitmap;
}

}  // namespace fairway
