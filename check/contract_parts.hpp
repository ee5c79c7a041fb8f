// The contract of a certificate, and which commands may be in force where: cells are divided into
// parts, and each part has the arc of all commands that may be obeyed in it.
//
// Lengths are in parts: part (x, y) is the square [x, x + 1] by [y, y + 1].
#pragma once

#include <cstdint>
#include <vector>

#include <nlohmann/json.hpp>

#include "check/flight.hpp"

namespace fairway_check {

/// Over the ground, without look-ahead and wind: never less than what the record says.
struct Contract {
  double command_error;  ///< metres, as are the radii
  double heading_error;  ///< rad
  /// Metres: that of the vehicle's estimate of its place, without look-ahead.
  double estimate_error;
  double least_radius;
  double most_radius;
  double least_speed;  ///< m/s
  double most_speed;
  double hold_side;       ///< rad
  double side_uncertain;  ///< rad
};

/// Throws Defect 1 for numbers out of range, nlohmann::json::exception for missing ones.
Contract contract_of(const nlohmann::json& contract);

/// Directions from `right`, counterclockwise through `width`.
struct Arc {
  double right = 0.0;
  double width = 7.0;  ///< 180 degrees or more: any direction
};

/// Places nearer than this to a part may be taken to be in it: its arc holds their commands, too.
inline constexpr double touch = 0x1p-24;
/// Headings nearer than this to the end of an arc may be taken to be in it, or out of it.
inline constexpr double angle_slack = 0x1p-26;

struct Parts {
  int per_cell = 1;
  int nx = 0;
  int ny = 0;
  double side_m = 0.0;
  std::vector<std::uint8_t> kind;  ///< [y][x], CellKind
  std::vector<Arc> arc;            ///< [y][x]

  std::size_t index(Cell p) const {
    return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(p.x);
  }
  Cell part_at(std::size_t index) const {
    return {static_cast<int>(index % static_cast<std::size_t>(nx)),
            static_cast<int>(index / static_cast<std::size_t>(nx))};
  }
  CellKind kind_at(Cell p) const {
    const bool inside = p.x >= 0 && p.x < nx && p.y >= 0 && p.y < ny;
    return inside ? static_cast<CellKind>(kind[index(p)]) : outside;
  }
};

/// Commands with those of the nearest cell that has one (by centres; of equally near ones the first
/// in the array) where there is none. All NaN when no cell has one.
std::vector<float> filled(const std::vector<float>& command_rad, int nx, int ny);

/// The smallest arc of the commands of all cells within the command error of a part, widened by the
/// heading error; a little wider than that, by the slacks above.
Parts parts_of(const Loop& loop, double cell_m, int per_cell, const Contract& contract);

}  // namespace fairway_check
