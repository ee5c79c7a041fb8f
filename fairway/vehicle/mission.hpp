// What the vehicle is asked to do: reach a place (paper 1, Eq. 4) or follow a path (Eq. 5).
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "fairway/base/vec2.hpp"

namespace fairway {

/// Reach the disc of radius beta * r about `goal_m`.
struct GoalMission {
  Vec2 goal_m;
  std::optional<double> goal_heading_rad;
  bool hold = false;  ///< and stay there: circle about the goal for ever
  std::optional<double> hold_radius_m = std::nullopt;  ///< and within this, if asked for
  friend bool operator==(const GoalMission&, const GoalMission&) = default;
};

/// What a path mission asks for: to join the path, stay on it and go on along it; or only to touch
/// it.
enum class PathAccept { follow, touch };

/// Follow a polyline of at least two distinct vertices, from the first to the last; `closed` also
/// joins the last to the first. The tolerances say when a state counts as on the path (Eq. 5).
struct PathMission {
  std::vector<Vec2> vertices_m;
  bool closed = false;
  double delta_position_m = 10.0;  ///< delta_x_max = delta_y_max
  double delta_heading_rad = 0.5;  ///< delta_theta_max
  PathAccept accept = PathAccept::follow;
  friend bool operator==(const PathMission&, const PathMission&) = default;
};

using Mission = std::variant<GoalMission, PathMission>;

}  // namespace fairway
