// What to steer at a state: the command of its cell, and the bang-bang turn towards it (paper 1,
// Eq. 8 in the buffer; the law under proof). No heap, no exceptions.
#pragma once

#include <cmath>
#include <limits>

#include "fairway/base/grid.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// What the plan commands at a state.
struct HeadingCommand {
  double heading_rad = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none, fly straight
  double turn_rate_radps = 0.0;  ///< positive to the left; 0 when aligned or without a command
};

/// `heading_rad`: [ny, nx], the plan's. No command outside the grid, nor for a state that is not
/// finite. Exactly opposite headings turn to either side, depending on rounding (docs/model.md).
inline HeadingCommand bang_bang(const Grid& grid, const Vehicle& vehicle, const float* heading_rad,
                                double x_m, double y_m, double h_rad) noexcept {
  HeadingCommand answer;
  if (!std::isfinite(x_m) || !std::isfinite(y_m) || !std::isfinite(h_rad)) return answer;
  // Positions far outside would overflow the index of a cell.
  const double far_m = 0x1p30 * grid.cell_m;
  if (!(std::abs(x_m - grid.x0_m) < far_m && std::abs(y_m - grid.y0_m) < far_m)) return answer;
  const Cell cell = grid.cell_of({x_m, y_m});
  if (!grid.contains(cell)) return answer;
  const double command_rad = static_cast<double>(heading_rad[grid.index(cell)]);
  if (std::isnan(command_rad)) return answer;
  answer.heading_rad = command_rad;
  const double turn_rad = std::remainder(command_rad - h_rad, 2.0 * 3.14159265358979323846);
  const double rate_radps = vehicle.speed_mps / vehicle.turn_radius_m;
  answer.turn_rate_radps = turn_rad == 0.0 ? 0.0 : turn_rad > 0.0 ? rate_radps : -rate_radps;
  return answer;
}

}  // namespace fairway
