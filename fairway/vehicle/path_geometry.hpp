// The geometry of a path mission's polyline: its pieces, its point nearest to a given one, and
// whether a state is on it (paper 1, Eq. 5).
#pragma once

#include <cstddef>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// A straight piece of a path, of nonzero length.
struct PathPiece {
  Vec2 from;
  Vec2 to;
  double length_m = 0.0;

  Vec2 tangent() const { return (1.0 / length_m) * (to - from); }
  Vec2 at(double along_m) const { return from + (along_m / length_m) * (to - from); }
};

/// Calls visit(PathPiece) in the order of travel, the closing piece of a closed path last; repeated
/// vertices give no pieces. Throws PreconditionViolation when the path has fewer than two vertices,
/// as do the functions below.
template <typename Visit>
void for_pieces(const PathMission& path, const Visit& visit) {
  const std::vector<Vec2>& v = path.vertices_m;
  require(v.size() >= 2, "a path has at least two vertices");
  const std::size_t pieces = path.closed ? v.size() : v.size() - 1;
  for (std::size_t i = 0; i < pieces; ++i) {
    const PathPiece piece{v[i], v[(i + 1) % v.size()], norm(v[(i + 1) % v.size()] - v[i])};
    if (piece.length_m > 0.0) visit(piece);
  }
}

/// From the first vertex to the end, the closing piece of a closed path included.
[[nodiscard]] double length_of(const PathMission& path);

/// The point of a path nearest to a given point; if several, the first along the path.
struct PathPoint {
  Vec2 position_m;
  Heading tangent;
  double distance_m = 0.0;
  double along_m = 0.0;  ///< from the first vertex
};
[[nodiscard]] PathPoint nearest_on_path(Vec2 point_m, const PathMission& path);

/// Membership in the goal set of a path mission (paper 1, Eq. 5): some point of the path has x and
/// y within delta_position_m and its tangent within delta_heading_rad, all strictly.
[[nodiscard]] bool on_path(const State& state, const PathMission& path);
/// The same of one of its pieces.
[[nodiscard]] bool on_piece(const State& state, const PathPiece& piece, const PathMission& path);

}  // namespace fairway
