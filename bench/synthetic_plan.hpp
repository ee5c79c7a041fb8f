// Plans without a map, for flights: "goal" is what plans look like (headings that change little
// from cell to cell, towards a goal in the centre), "meander" makes the vehicle turn all the time,
// "rough" has an independent heading in every cell, unlike any real plan.
#pragma once

#include <cmath>
#include <cstddef>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway::bench {

enum class FieldKind { goal, meander, rough };

/// n by n cells of 2 m, turning radius 5 m.
[[nodiscard]] inline Plan synthetic_plan(int n, FieldKind kind) {
  Plan plan;
  plan.grid = {n, n, 0.0, 0.0, 2.0};
  plan.vehicle = {10.0, 5.0};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  plan.heading_rad.resize(plan.grid.size());
  Random random(3);
  const Vec2 goal{n * 1.0, n * 1.0};
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Vec2 p = plan.grid.center(plan.grid.cell_at(i));
    const Vec2 to_goal = goal - p;
    const double distance = norm(to_goal);
    double heading = std::atan2(to_goal.y, to_goal.x);
    if (kind == FieldKind::goal) heading += 0.7 * std::sin(p.x / 37.0) * std::cos(p.y / 53.0);
    if (kind == FieldKind::meander) heading += 1.4 * std::sin(p.x / 6.0) * std::cos(p.y / 7.0);
    if (kind == FieldKind::rough) heading = random.uniform(-pi, pi);
    plan.heading_rad[i] = Heading::stored(heading);
    if (distance < 10.0 && kind != FieldKind::rough) plan.region[i] = Region::goal;
  }
  return plan;
}

}  // namespace fairway::bench
