// The nearest point of a path, and whether a state is on it, for many points: the answers of
// path_geometry.hpp, found through boxes about runs of pieces instead of piece by piece.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/path_frame.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway {

class PathLocator {
 public:
  /// Throws PreconditionViolation when the path has fewer than two vertices.
  explicit PathLocator(PathMission path);

  /// nearest_on_path, but for ties that rounding decides.
  [[nodiscard]] PathPoint nearest(Vec2 point_m) const;
  /// The same, sooner: `piece` is a guess of the piece that it lies on, below size(), and becomes
  /// it.
  [[nodiscard]] PathPoint nearest(Vec2 point_m, std::size_t& piece) const;
  /// The same; none when it is farther away than `limit_m`.
  [[nodiscard]] std::optional<PathPoint> nearest_within(Vec2 point_m, double limit_m) const;
  /// The same point as a frame, with the side on which the place lies.
  [[nodiscard]] PathFrame frame(Vec2 point_m) const;
  /// The place at a station: a closed path goes round, an open one straight on beyond its ends.
  [[nodiscard]] Vec2 place(double station_m) const;
  /// on_path (paper 1, Eq. 5).
  [[nodiscard]] bool on_path(const State& state) const;
  /// The same, sooner where it is so on this piece.
  [[nodiscard]] bool on_path(const State& state, std::size_t piece) const;

  const PathMission& path() const { return path_; }
  double length_m() const { return length_m_; }
  std::size_t size() const { return pieces_.size(); }

 private:
  struct Box {
    Vec2 low;
    Vec2 high;
  };
  struct Found;

  PathFrame frame_at_vertex(Vec2 point_m, const Found& found) const;
  Found find(Vec2 point_m) const;
  Box box_over(std::size_t node, std::size_t first, std::size_t last);
  void look(Vec2 point, std::size_t piece, Found& found) const;
  void search(Vec2 point, std::size_t node, std::size_t first, std::size_t last,
              Found& found) const;
  bool any_on(const State& state, std::size_t node, std::size_t first, std::size_t last) const;

  PathMission path_;
  std::vector<PathPiece> pieces_;
  std::vector<double> before_m_;  // [piece] of the path
  std::vector<Box> boxes_;        // a binary tree: the children of k are 2 k + 1 and 2 k + 2
  double length_m_ = 0.0;
};

}  // namespace fairway
