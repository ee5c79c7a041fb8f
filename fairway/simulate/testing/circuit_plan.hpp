// A plan made by hand that leads onto a round circuit and along it: for tests of following.
#pragma once

#include <cmath>
#include <cstddef>

#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway::testing {

inline constexpr Vec2 circuit_middle{64.0, 64.0};
inline constexpr double circuit_radius_m = 40.0;

/// A closed polygon of 90 edges about circuit_middle; `way`: 1 counter-clockwise, -1 clockwise.
inline PathMission circuit_path(double way) {
  PathMission path;
  path.closed = true;
  path.delta_position_m = 3.0;
  path.delta_heading_rad = 0.4;
  for (int k = 0; k < 90; ++k) {
    const double at = way * two_pi * k / 90.0;
    path.vertices_m.push_back(circuit_middle + circuit_radius_m * Vec2{std::cos(at), std::sin(at)});
  }
  return path;
}

/// 64 x 64 cells of 2 m, 10 m/s, radius 5 m, all free but for the cells near the circuit, which are
/// goal cells.
inline Plan circuit_plan(double way = 1.0) {
  Plan plan;
  plan.grid = {64, 64, 0.0, 0.0, 2.0};
  plan.vehicle = {10.0, 5.0};
  const PathMission path = circuit_path(way);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Vec2 from_middle = plan.grid.center(plan.grid.cell_at(i)) - circuit_middle;
    const double off_m = norm(from_middle) - circuit_radius_m;
    // Along the circuit, turned towards it by up to a right angle.
    const double around = std::atan2(from_middle.y, from_middle.x) + way * pi / 2;
    plan.heading_rad.push_back(Heading::stored(around + way * std::atan(off_m / 6.0)));
    plan.region.push_back(std::abs(off_m) < 1.5 ? Region::goal : Region::free);
    plan.cost_m.push_back(static_cast<float>(std::abs(off_m)));
  }
  plan.record.mission = path;
  return plan;
}

/// The same with a wall of obstacle cells across the circuit, at the middle's left.
inline Plan walled_circuit_plan() {
  Plan plan = circuit_plan();
  for (int ix = 2; ix < 20; ++ix) plan.region[plan.grid.index({ix, 32})] = Region::obstacle;
  return plan;
}

}  // namespace fairway::testing
