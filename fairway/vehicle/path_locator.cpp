#include "fairway/vehicle/path_locator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fairway {
namespace {

/// By how far a point lies outside a range; 0 within.
double outside(double x, double low, double high) { return std::max({low - x, x - high, 0.0}); }

}  // namespace

struct PathLocator::Found {
  PathPoint nearest;
  std::size_t piece = 0;
};

PathLocator::PathLocator(PathMission path) : path_(std::move(path)) {
  for_pieces(path_, [&](const PathPiece& piece) {
    pieces_.push_back(piece);
    before_m_.push_back(length_m_);
    length_m_ += piece.length_m;
  });
  if (!pieces_.empty()) box_over(0, 0, pieces_.size());
}

PathLocator::Box PathLocator::box_over(std::size_t node, std::size_t first, std::size_t last) {
  if (boxes_.size() <= node) boxes_.resize(node + 1);
  Box box;
  if (last - first == 1) {
    const auto [from, to, length] = pieces_[first];
    box = {{std::min(from.x, to.x), std::min(from.y, to.y)},
           {std::max(from.x, to.x), std::max(from.y, to.y)}};
  } else {
    const std::size_t middle = first + (last - first) / 2;
    const Box a = box_over(2 * node + 1, first, middle);
    const Box b = box_over(2 * node + 2, middle, last);
    box = {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
           {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
  }
  return boxes_[node] = box;
}

void PathLocator::look(Vec2 point, std::size_t piece, Found& found) const {
  const PathPiece& at = pieces_[piece];
  const double t_m = std::clamp(dot(point - at.from, at.tangent()), 0.0, at.length_m);
  const Vec2 q = at.at(t_m);
  const double distance_m = norm(point - q);
  const PathPoint& best = found.nearest;
  if (distance_m < best.distance_m || (distance_m == best.distance_m && piece < found.piece)) {
    found = {{q, Heading::of(at.to - at.from), distance_m, before_m_[piece] + t_m}, piece};
  }
}

/// Of the pieces [first, last). Of equally near ones the first, as nearest_on_path has it; boxes
/// are given a rounding's slack, so that none of them is passed over.
void PathLocator::search(Vec2 point, std::size_t node, std::size_t first, std::size_t last,
                         Found& found) const {
  if (last - first == 1) return look(point, first, found);
  const auto away_m = [&](std::size_t child) {
    const Box& box = boxes_[child];
    const double dx = outside(point.x, box.low.x, box.high.x);
    const double dy = outside(point.y, box.low.y, box.high.y);
    return (1.0 - 1e-9) * std::sqrt(dx * dx + dy * dy);
  };
  const std::size_t middle = first + (last - first) / 2;
  const std::size_t left = 2 * node + 1;
  const std::size_t right = left + 1;
  const double to_left_m = away_m(left);
  const double to_right_m = away_m(right);
  const bool right_first = to_right_m < to_left_m;
  for (const bool on_right : {right_first, !right_first}) {
    const double slack_m = 1e-9 * found.nearest.distance_m;
    if ((on_right ? to_right_m : to_left_m) > found.nearest.distance_m + slack_m) continue;
    if (on_right) {
      search(point, right, middle, last, found);
    } else {
      search(point, left, first, middle, found);
    }
  }
}

PathLocator::Found PathLocator::find(Vec2 point_m) const {
  Found found;
  found.nearest.distance_m = std::numeric_limits<double>::infinity();
  if (!pieces_.empty()) search(point_m, 0, 0, pieces_.size(), found);
  return found;
}

PathPoint PathLocator::nearest(Vec2 point_m) const { return find(point_m).nearest; }

PathPoint PathLocator::nearest(Vec2 point_m, std::size_t& piece) const {
  Found found{{}, piece};
  found.nearest.distance_m = std::numeric_limits<double>::infinity();
  if (pieces_.empty()) return found.nearest;
  look(point_m, piece, found);
  search(point_m, 0, 0, pieces_.size(), found);
  piece = found.piece;
  return found.nearest;
}

std::optional<PathPoint> PathLocator::nearest_within(Vec2 point_m, double limit_m) const {
  Found found{{}, pieces_.size()};
  found.nearest.distance_m = limit_m;
  if (!pieces_.empty()) search(point_m, 0, 0, pieces_.size(), found);
  if (found.piece == pieces_.size()) return {};
  return found.nearest;
}

/// The nearest point is a vertex, or an open end.
PathFrame PathLocator::frame_at_vertex(Vec2 point_m, const Found& found) const {
  const std::size_t n = pieces_.size();
  const std::size_t piece = found.piece;
  const bool at_its_end = found.nearest.along_m > before_m_[piece];
  const bool open_end = !path_.closed && (at_its_end ? piece + 1 == n : piece == 0);
  const Vec2 way = point_m - found.nearest.position_m;
  const Vec2 before = pieces_[at_its_end ? piece : (piece + n - 1) % n].tangent();
  const Vec2 after = pieces_[at_its_end ? (piece + 1) % n : piece].tangent();
  PathFrame out{found.nearest.along_m, found.nearest.distance_m, before, 0.0};
  if (open_end) {
    out.tangent = at_its_end ? before : after;
    out.beyond_m = std::max(0.0, at_its_end ? dot(way, before) : -dot(way, after));
    if (cross(out.tangent, way) < 0.0) out.offset_m = -out.offset_m;
    return out;
  }
  // The wedge lies on one side of the mean direction. Where the path turns back on itself there is
  // none: the place beyond is on the right.
  const Vec2 mean = before + after;
  const bool on_right = norm2(mean) < 1e-20 || cross(mean, way) < 0.0;
  if (out.offset_m > 0.0) out.tangent = (on_right ? 1.0 : -1.0) / out.offset_m * left_of(way);
  if (on_right) out.offset_m = -out.offset_m;
  return out;
}

PathFrame PathLocator::frame(Vec2 point_m) const {
  const Found found = find(point_m);
  if (pieces_.empty()) return {0.0, found.nearest.distance_m, {1.0, 0.0}, 0.0};
  const PathPiece& piece = pieces_[found.piece];
  const double along_m = dot(point_m - piece.from, piece.tangent());
  if (along_m <= 0.0 || along_m >= piece.length_m) return frame_at_vertex(point_m, found);
  const bool on_left = cross(piece.tangent(), point_m - piece.from) >= 0.0;
  const double distance_m = found.nearest.distance_m;
  return {found.nearest.along_m, on_left ? distance_m : -distance_m, piece.tangent(), 0.0};
}

Vec2 PathLocator::place(double station_m) const {
  if (pieces_.empty()) return path_.vertices_m.front();
  if (path_.closed) {
    station_m = std::fmod(station_m, length_m_);
    if (station_m < 0.0) station_m += length_m_;
  }
  const auto after = std::upper_bound(before_m_.begin() + 1, before_m_.end(), station_m);
  const auto piece = static_cast<std::size_t>(after - before_m_.begin()) - 1;
  return pieces_[piece].at(station_m - before_m_[piece]);
}

bool PathLocator::any_on(const State& state, std::size_t node, std::size_t first,
                         std::size_t last) const {
  const Box& box = boxes_[node];
  const Vec2 p = state.position_m;
  const double limit_m = path_.delta_position_m;
  if (outside(p.x, box.low.x, box.high.x) > limit_m ||
      outside(p.y, box.low.y, box.high.y) > limit_m) {
    return false;
  }
  if (last - first == 1) return on_piece(state, pieces_[first], path_);
  const std::size_t middle = first + (last - first) / 2;
  return any_on(state, 2 * node + 1, first, middle) || any_on(state, 2 * node + 2, middle, last);
}

bool PathLocator::on_path(const State& state, std::size_t piece) const {
  return (piece < pieces_.size() && on_piece(state, pieces_[piece], path_)) || on_path(state);
}

bool PathLocator::on_path(const State& state) const {
  return !pieces_.empty() && any_on(state, 0, 0, pieces_.size());
}

}  // namespace fairway
