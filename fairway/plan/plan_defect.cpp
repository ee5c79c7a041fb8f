#include "fairway/plan/plan_defect.hpp"

#include <atomic>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/vehicle/contract_defect.hpp"
#include "fairway/vehicle/modes.hpp"
#include "fairway/vehicle/size_range.hpp"

namespace fairway {
namespace {

/// Closer to its axis than this (only 0: no float is so close to another axis) a command is not on
/// the axis, but the arithmetic of the proof cannot distinguish it from the axis.
bool is_beside_axis(double heading_rad) {
  return heading_rad != 0.0 && std::abs(heading_rad) < 0x1p-52;
}

bool heading_valid(double heading_rad) {
  return heading_rad > -pi && heading_rad <= pi && !is_beside_axis(heading_rad);
}

bool cell_valid(const Plan& plan, std::size_t i) {
  const double heading_rad = plan.heading_rad[i];
  const int region = static_cast<int>(plan.region[i]);
  const bool may_lack_heading = plan.cost_m[i] == std::numeric_limits<float>::infinity() ||
                                plan.region[i] == Region::obstacle;
  return plan.cost_m[i] >= 0.0F && region >= -1 && region <= 2 &&
         (heading_valid(heading_rad) || (std::isnan(heading_rad) && may_lack_heading));
}

std::string cell_defect(const Plan& plan, std::size_t i) {
  const double heading_rad = plan.heading_rad[i];
  const float cost_m = plan.cost_m[i];
  const int region = static_cast<int>(plan.region[i]);
  if (!std::isnan(heading_rad) && !(heading_rad > -pi && heading_rad <= pi)) {
    return fmt::format("heading_rad is {}, expected (-pi, pi] or NaN", heading_rad);
  }
  if (is_beside_axis(heading_rad)) {
    return fmt::format("heading_rad is {}, expected 0 or at least 2^-52 from it", heading_rad);
  }
  if (!(cost_m >= 0.0F)) return fmt::format("cost_m is {}, expected >= 0 or infinity", cost_m);
  if (region < -1 || region > 2) {
    return fmt::format("region is {}, expected -1, 0, 1 or 2", region);
  }
  return "heading_rad is NaN, expected a heading where cost_m is finite";
}

/// Of the arrays of further modes.
std::string mode_defect(const Plan& plan) {
  const std::size_t n = plan.grid.size();
  const std::size_t further = plan.further_modes();
  if (plan.mode_heading_rad.size() != further * n) {
    return "mode_heading_rad does not have one entry per mode and cell";
  }
  if (further >= most_modes) {
    return fmt::format("has {} modes, expected at most {}", further + 1, most_modes);
  }
  if (further != plan.record.modes.size()) {
    return fmt::format("has {} further modes, but its record tells of {}", further,
                       plan.record.modes.size());
  }
  for (std::size_t i = 0; i < plan.mode_heading_rad.size(); ++i) {
    const double heading_rad = plan.mode_heading_rad[i];
    if (std::isnan(heading_rad) || heading_valid(heading_rad)) continue;
    const Cell c = plan.grid.cell_at(i % n);
    return fmt::format(
        "mode {}, cell ix {} iy {}: mode_heading_rad is {}, expected (-pi, pi], 0 or at least "
        "2^-52 "
        "from it, or NaN",
        i / n + 1, c.ix, c.iy, heading_rad);
  }
  return {};
}

}  // namespace

std::string geometry_defect(const Grid& grid, const Vehicle& vehicle) {
  if (grid.nx < 1 || grid.ny < 1) return "the grid has no cells";
  if (!size_range::holds(grid.cell_m)) {
    return fmt::format("cell_m is {} m, expected 1e-15 to 1e15", grid.cell_m);
  }
  if (!size_range::holds(vehicle.speed_mps)) {
    return fmt::format("speed_mps is {} m/s, expected 1e-15 to 1e15", vehicle.speed_mps);
  }
  if (!(grid.cell_m < vehicle.turn_radius_m)) {
    return fmt::format("cell_m is {} m, expected less than turn_radius_m, {} m", grid.cell_m,
                       vehicle.turn_radius_m);
  }
  if (!size_range::holds_radius(vehicle.turn_radius_m, grid.cell_m)) {
    return fmt::format("turn_radius_m is {} m, expected at most 1e9 cells", vehicle.turn_radius_m);
  }
  if (!size_range::holds_origin(grid.x0_m, grid.cell_m) ||
      !size_range::holds_origin(grid.y0_m, grid.cell_m)) {
    return fmt::format("origin_m is [{}, {}], expected within 1e9 cells and 1e15 m of zero",
                       grid.x0_m, grid.y0_m);
  }
  return {};
}

std::string plan_defect(const Plan& plan) {
  if (const std::string defect = geometry_defect(plan.grid, plan.vehicle); !defect.empty()) {
    return defect;
  }
  if (plan.record.contract) {
    if (const auto defect = contract_defect(*plan.record.contract, plan.vehicle)) {
      return fmt::format("contract.{}: {}", defect->key, defect->what);
    }
  }
  const std::size_t n = plan.grid.size();
  if (plan.heading_rad.size() != n || plan.region.size() != n || plan.cost_m.size() != n) {
    return "an array does not have one entry per cell";
  }
  std::atomic<std::size_t> first{n};  // the lowest, whichever thread finds it
  for_ranges(n, 1 << 16, [&](std::size_t begin, std::size_t end) {
    std::size_t i = begin;
    while (i < end && cell_valid(plan, i)) ++i;
    std::size_t lowest = first.load();
    while (i < end && i < lowest && !first.compare_exchange_weak(lowest, i)) {
    }
  });
  if (first == n) return mode_defect(plan);
  const Cell c = plan.grid.cell_at(first);
  return fmt::format("cell ix {} iy {}: {}", c.ix, c.iy, cell_defect(plan, first));
}

}  // namespace fairway
