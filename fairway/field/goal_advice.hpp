// What to try when a goal does not fit: nearby goals that do, and how much of the map each serves;
// or, where none fits, how much smaller the vehicle's turns would have to be.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// A cell's centre around which the goal disc lies in free cells.
struct GoalPlace {
  Vec2 place_m;
  int decimals = 2;     ///< decimals of metres with which it still fits; five more for degrees
  double serves = 0.0;  ///< share of all free cells that are connected to it
};

/// The place with the largest clearance, and the values that would fit there, each changed alone.
struct GoalRoom {
  Vec2 place_m;
  int decimals = 2;
  double clearance_m = 0.0;  ///< to the nearest obstacle cell, in the buffer's metric
  std::optional<double> turn_radius_m;
  std::optional<double> alpha;
  std::optional<double> beta;
};

struct GoalAdvice {
  std::optional<GoalPlace> nearest;  ///< to the goal asked for
  std::optional<GoalPlace>
      in_largest_part;           ///< the nearest in the largest part that a goal fits in
  std::optional<GoalRoom> room;  ///< where no goal fits and some cell is not an obstacle
};

/// `region` without goal cells. Places are centres of cells, rounded to centimetres, or finer where
/// cells are a few centimetres wide; they fit as rounded, in metres and in degrees.
[[nodiscard]] GoalAdvice goal_advice(const ObstacleMap& map, const std::vector<Region>& region,
                                     Vec2 goal_m, const Vehicle& vehicle,
                                     const FieldOptions& options);

/// The largest part of the free cells that a goal fits in: the place in it with the largest
/// clearance. Nothing where no goal fits.
[[nodiscard]] std::optional<GoalPlace> roomiest_goal(const ObstacleMap& map,
                                                     const std::vector<Region>& region,
                                                     const Vehicle& vehicle,
                                                     const FieldOptions& options);

/// "[x, y]", a PlaceText.
[[nodiscard]] std::string metres_text(Vec2 place_m, int decimals);

/// "the nearest goal that fits is ..., which serves 3 % of the free cells; ...".
[[nodiscard]] std::string words(const GoalAdvice& advice, const PlaceText& place);

}  // namespace fairway
