// The sizes that Fairway supports: one range for plans, certificates and queries in the vehicle.
// docs/formats.md gives it, and fairway-check has the same.
#pragma once

#include <cmath>

#include "fairway/base/grid.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway::size_range {

inline constexpr double least = 1e-15;     ///< of a cell in metres, and of the speed in m/s
inline constexpr double most = 1e15;       ///< of these, and of the origin's coordinates
inline constexpr double most_cells = 1e9;  ///< in a turning radius, or from zero to the origin

/// For a cell's side or the speed; false for NaN.
inline bool holds(double size) { return size >= least && size <= most; }

inline bool holds_radius(double turn_radius_m, double cell_m) {
  return turn_radius_m > cell_m && turn_radius_m <= most_cells * cell_m;
}
/// Beyond it neighbouring borders coincide.
inline bool holds_origin(double coordinate_m, double cell_m) {
  return std::abs(coordinate_m) <= most && std::abs(coordinate_m) <= most_cells * cell_m;
}

inline bool holds(const Grid& grid, const Vehicle& vehicle) {
  return holds(grid.cell_m) && holds(vehicle.speed_mps) &&
         holds_radius(vehicle.turn_radius_m, grid.cell_m) && holds_origin(grid.x0_m, grid.cell_m) &&
         holds_origin(grid.y0_m, grid.cell_m);
}

}  // namespace fairway::size_range
