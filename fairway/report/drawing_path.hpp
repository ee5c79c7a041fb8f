// An outline on the page: straight lines and exact circular arcs. Points (1/72 inch), x to the
// right, y down.
#pragma once

#include <vector>

#include "fairway/base/vec2.hpp"

namespace fairway {

class DrawingPath {
 public:
  enum class Kind { move, line, arc, close };
  /// `end` is where the piece ends. For an arc: `center`, `radius`, the angle it starts at and the
  /// signed angle it sweeps, both from +x towards +y (clockwise on the page).
  struct Piece {
    Kind kind = Kind::move;
    Vec2 end;
    Vec2 center;
    double radius = 0.0;
    double from_rad = 0.0;
    double sweep_rad = 0.0;
  };

  DrawingPath& move_to(Vec2 p) {
    pieces_.push_back({Kind::move, p, {}, 0.0, 0.0, 0.0});
    return *this;
  }
  DrawingPath& line_to(Vec2 p) {
    pieces_.push_back({Kind::line, p, {}, 0.0, 0.0, 0.0});
    return *this;
  }
  /// Goes on from the last end along a circle that holds it; the end is that of the circle.
  DrawingPath& arc(Vec2 center, double radius, double from_rad, double sweep_rad) {
    const double a = from_rad + sweep_rad;
    const Vec2 end{center.x + radius * std::cos(a), center.y + radius * std::sin(a)};
    pieces_.push_back({Kind::arc, end, center, radius, from_rad, sweep_rad});
    return *this;
  }
  DrawingPath& close() {
    pieces_.push_back({Kind::close, {}, {}, 0.0, 0.0, 0.0});
    return *this;
  }

  const std::vector<Piece>& pieces() const { return pieces_; }
  bool empty() const { return pieces_.empty(); }

  static DrawingPath rectangle(Vec2 corner, double width, double height) {
    DrawingPath path;
    path.move_to(corner).line_to({corner.x + width, corner.y});
    path.line_to({corner.x + width, corner.y + height}).line_to({corner.x, corner.y + height});
    return path.close();
  }
  static DrawingPath circle(Vec2 center, double radius) {
    DrawingPath path;
    path.move_to({center.x + radius, center.y}).arc(center, radius, 0.0, 6.283185307179586);
    return path.close();
  }
  /// An open line through all points; empty when there are fewer than two.
  static DrawingPath polyline(const std::vector<Vec2>& points) {
    DrawingPath path;
    if (points.size() < 2) return path;
    path.move_to(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) path.line_to(points[i]);
    return path;
  }

 private:
  std::vector<Piece> pieces_;
};

}  // namespace fairway
