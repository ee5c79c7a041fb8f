#include "fairway/vehicle/path_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fairway {

namespace {

/// Whether some t in [0, 1] has |a + t (b - a) - p| < limit, component by component.
bool edge_in_box(Vec2 a, Vec2 b, Vec2 p, double limit) {
  double low = 0.0;
  double high = 1.0;
  const auto clip = [&](double from, double step) {  // |from + t step| < limit
    if (step == 0.0) return std::abs(from) < limit;
    const double t0 = (-limit - from) / step;
    const double t1 = (limit - from) / step;
    low = std::max(low, std::min(t0, t1));
    high = std::min(high, std::max(t0, t1));
    return true;
  };
  if (!clip(a.x - p.x, b.x - a.x) || !clip(a.y - p.y, b.y - a.y) || low > high) return false;
  if (low < high) return true;
  // One common point with the closed box: an end of the edge inside it, or a touch, not counted.
  const Vec2 q = a + low * (b - a);
  return std::abs(q.x - p.x) < limit && std::abs(q.y - p.y) < limit;
}

}  // namespace

double length_of(const PathMission& path) {
  double sum_m = 0.0;
  for_pieces(path, [&](const PathPiece& piece) { sum_m += piece.length_m; });
  return sum_m;
}

PathPoint nearest_on_path(Vec2 point_m, const PathMission& path) {
  PathPoint nearest;
  nearest.distance_m = std::numeric_limits<double>::infinity();
  double before_m = 0.0;
  for_pieces(path, [&](const PathPiece& piece) {
    const double t_m = std::clamp(dot(point_m - piece.from, piece.tangent()), 0.0, piece.length_m);
    const Vec2 q = piece.at(t_m);
    const double distance_m = norm(point_m - q);
    if (distance_m < nearest.distance_m) {
      nearest = {q, Heading::of(piece.to - piece.from), distance_m, before_m + t_m};
    }
    before_m += piece.length_m;
  });
  return nearest;
}

bool on_piece(const State& state, const PathPiece& piece, const PathMission& path) {
  const Heading along = Heading::of(piece.to - piece.from);
  return edge_in_box(piece.from, piece.to, state.position_m, path.delta_position_m) &&
         std::abs(state.heading.turn_to(along)) < path.delta_heading_rad;
}

bool on_path(const State& state, const PathMission& path) {
  bool found = false;
  for_pieces(path, [&](const PathPiece& piece) { found = found || on_piece(state, piece, path); });
  return found;
}

}  // namespace fairway
