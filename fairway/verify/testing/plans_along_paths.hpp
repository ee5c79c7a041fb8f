// Plans for tests: commands that approach a path on circles and run along it.
#pragma once

#include <algorithm>
#include <cmath>

#include "fairway/base/heading.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/vehicle/path_locator.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {

/// On `nx` by `ny` cells of 8 m of open water, for a turning radius of 20 m; circles of 60 m.
inline Plan plan_along(const PathMission& path, int nx, int ny) {
  Plan plan = empty_plan(nx, ny, 8.0, 20.0);
  const PathLocator locator(path);
  plan.record.mission = path;
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const PathFrame frame = locator.frame(plan.grid.center(plan.grid.cell_at(i)));
    const double off = std::acos(1.0 - std::min(1.0, std::abs(frame.offset_m) / 60.0));
    const double tangent = std::atan2(frame.tangent.y, frame.tangent.x);
    // Less than pi, as a float, too.
    plan.heading_rad[i] = static_cast<float>(
        0.9999 * std::remainder(tangent + (frame.offset_m > 0.0 ? -off : off), 2.0 * pi));
    plan.cost_m[i] = static_cast<float>(std::abs(frame.offset_m));
  }
  return plan;
}

/// A round trip, for plan_along(_, 32, 30).
inline PathMission ellipse_to_follow() {
  PathMission path;
  path.closed = true;
  for (int k = 0; k < 72; ++k) {
    const double at = 2.0 * pi * k / 72.0;
    path.vertices_m.push_back({128.0 + 84.0 * std::cos(at), 120.0 + 76.0 * std::sin(at)});
  }
  return path;
}

/// Open, for plan_along(_, 30, 15).
inline PathMission line_to_follow() {
  PathMission path;
  path.vertices_m = {{40.0, 60.0}, {200.0, 60.0}};
  return path;
}

/// One under which both are followed.
inline VehicleContract contract_to_follow() {
  VehicleContract contract;
  contract.command_error_m = 1.0;
  contract.heading_error_rad = 0.01;
  contract.turn_radius_m = {19.0, 21.0};
  contract.speed_mps = {9.0, 11.0};
  return contract;
}

}  // namespace fairway
