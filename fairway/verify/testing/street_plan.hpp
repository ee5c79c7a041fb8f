// For tests: a plan with modes. A street too narrow for the vehicle to turn round in leads from the
// goal, at its left end, to a square. Who flies away from the goal in the street is lost in mode 0;
// modes that go on in one direction bring it to the square, from where mode 0 does turn round.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "fairway/base/heading.hpp"
#include "fairway/field/direction_field.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway {

/// 46 x 25 cells of 2 m, turning radius 6 m, street of 5 cells. `directions` further modes.
inline Plan street_plan(int directions) {
  Plan plan;
  plan.grid = {46, 25, 0.0, 0.0, 2.0};
  plan.vehicle = {10.0, 6.0};
  plan.region.assign(plan.grid.size(), Region::obstacle);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  plan.heading_rad.assign(plan.grid.size(), std::nanf(""));
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    const bool street = c.ix >= 1 && c.ix < 27 && c.iy >= 10 && c.iy < 15;
    const bool square = c.ix >= 27 && c.ix < 45 && c.iy >= 1 && c.iy < 24;
    if (!street && !square) continue;
    plan.region[i] = street && c.ix < 4 ? Region::goal : Region::free;
    const Vec2 p = plan.grid.center(c);
    // To the middle of the street, which no border runs along: a weave over it takes long to prove;
    // in the square towards its mouth.
    const Vec2 to = street ? Vec2{-8.0, 25.0 - p.y} : Vec2{50.0 - p.x, 25.0 - p.y};
    plan.heading_rad[i] = Heading::stored(std::atan2(to.y, to.x));
  }
  for (int k = 0; k < directions; ++k) {
    const double direction_rad = 2.0 * pi * k / directions;
    const std::vector<float> field = direction_field(plan.grid, plan.region, direction_rad, 8.0);
    plan.mode_heading_rad.insert(plan.mode_heading_rad.end(), field.begin(), field.end());
    plan.record.modes.push_back({"direction", direction_rad});
  }
  return plan;
}

}  // namespace fairway
