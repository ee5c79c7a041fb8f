// What of a path a vehicle of bounded curvature cannot fly: corners without room to round them, a
// path that fits into a turning circle, crossings of a path with itself.
//
// A corner that turns by phi is rounded by an arc of radius r that begins r tan(phi / 2) before the
// vertex and ends as far behind it. Along a leg the arcs of both its ends must have room.
// Before corners are looked at, vertices that lie within r / 50 of a line between others are left
// out: a dense polyline then has a few long legs, and what lacks less than r / 5 is no trouble. So
// a polyline of a circle wider than r by more than that r / 50 has none, however unevenly it is
// sampled; one of a narrower circle has, once it has turned far enough for r / 5 to be lacking.
#pragma once

#include <string>
#include <vector>

#include "fairway/vehicle/mission.hpp"

namespace fairway {

struct PathTrouble {
  enum class Kind { fits_into_a_turn, sharp_vertex, short_leg, narrow_bend, crossing };
  Kind kind;
  std::size_t first_vertex = 0;  ///< from 0: where it begins, and where it ends
  std::size_t last_vertex = 0;
  std::string message;  ///< a sentence without a full stop; counts vertices from 1
};

/// In the order of travel, crossings last; those of a kind that follow each other are one, as are
/// all crossings. Throws PreconditionViolation when the path has fewer than two vertices.
[[nodiscard]] std::vector<PathTrouble> path_troubles(const PathMission& path, double turn_radius_m);

/// A point that two pieces share that do not follow each other.
struct PathCrossing {
  std::size_t first_piece = 0;  ///< from 0: the piece from vertex k to k + 1 is k
  std::size_t second_piece = 0;
  Vec2 position_m;
};

/// By first piece, then by second. Pieces that run back over the one before share more than their
/// vertex and count as well. About linear in the pieces where they are short beside the path.
[[nodiscard]] std::vector<PathCrossing> path_crossings(const PathMission& path);

}  // namespace fairway
