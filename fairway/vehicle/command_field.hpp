// The command for any place, as a vehicle under a contract takes it (vehicle/contract.hpp, rule 1;
// docs/model.md, "Under a contract"): in cells without a command, too, and outside the grid.
//
// Takes memory when it is made, 4 bytes a cell (and 4 more meanwhile); no question takes any, and
// questions may come from several threads at once. No exceptions but for memory that is not there.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/vehicle/nearest_command.hpp"

namespace fairway {

class CommandField {
 public:
  /// `heading_rad`: the plan's, [iy][ix]; not needed any more afterwards.
  CommandField(const Grid& grid, const float* heading_rad)
      : grid_(grid), heading_rad_(heading_rad, heading_rad + grid.size()) {
    std::vector<int> row(grid.size());
    find_nearest_rows(grid, heading_rad, row.data());
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (!std::isnan(heading_rad_[i])) continue;
      const std::size_t nearest = cell_in_command(grid, row.data(), grid.cell_at(i));
      if (nearest < grid.size()) heading_rad_[i] = heading_rad[nearest];
    }
  }

  /// The command at a place, radians in (-pi, pi]: that of its cell, or of the nearest cell that
  /// has one. Outside the grid: at the nearest place on it. NaN only for a place that is not a
  /// number, and where the plan has no command at all.
  double command_rad(double x_m, double y_m) const noexcept {
    if (std::isnan(x_m) || std::isnan(y_m)) return std::numeric_limits<double>::quiet_NaN();
    const Cell cell{index_of((x_m - grid_.x0_m) / grid_.cell_m, grid_.nx),
                    index_of((y_m - grid_.y0_m) / grid_.cell_m, grid_.ny)};
    return static_cast<double>(heading_rad_[grid_.index(cell)]);
  }

 private:
  static int index_of(double in_cells, int count) noexcept {
    if (!(in_cells > 0.0)) return 0;
    return in_cells < count ? static_cast<int>(in_cells) : count - 1;
  }

  Grid grid_;
  std::vector<float> heading_rad_;
};

/// The point `look_ahead_m` ahead of a place, along the course.
inline Vec2 point_ahead(double x_m, double y_m, double course_rad, double look_ahead_m) noexcept {
  return {x_m + look_ahead_m * std::cos(course_rad), y_m + look_ahead_m * std::sin(course_rad)};
}

}  // namespace fairway
