// A static view of things in three dimensions: parallel projection, faces drawn from far to near.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "fairway/report/canvas.hpp"

namespace fairway::reproduce {

struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

/// Where the corner (0, 0, 0) lies on the page, points, and where one unit along each axis leads.
/// x runs to the right and towards the reader, y to the right and away, z up.
struct SolidView {
  Vec2 origin_pt;
  Vec2 x_pt;
  Vec2 y_pt;
  Vec2 z_pt;

  Vec2 at(const Vec3& p) const { return origin_pt + p.x * x_pt + p.y * y_pt + p.z * z_pt; }
};

class SolidScene {
 public:
  explicit SolidScene(const SolidView& view) : view_(view) {}

  void add_face(const std::vector<Vec3>& corners, const Color& color,
                const std::optional<Pen>& edge = {}) {
    Vec3 middle;
    for (const Vec3& c : corners) middle = {middle.x + c.x, middle.y + c.y, middle.z + c.z};
    const auto n = static_cast<double>(corners.size());
    // Far is behind in y, then left in x, then low.
    faces_.push_back({(middle.y - 0.6 * middle.x - 0.3 * middle.z) / n, corners, color, edge});
  }
  void draw(Canvas& canvas) {
    std::stable_sort(faces_.begin(), faces_.end(),
                     [](const Face& a, const Face& b) { return a.depth > b.depth; });
    for (const Face& face : faces_) {
      DrawingPath path;
      path.move_to(view_.at(face.corners.front()));
      for (std::size_t i = 1; i < face.corners.size(); ++i) path.line_to(view_.at(face.corners[i]));
      path.close();
      canvas.fill(path, face.color);
      if (face.edge) canvas.stroke(path, *face.edge);
    }
    faces_.clear();
  }

 private:
  struct Face {
    double depth;
    std::vector<Vec3> corners;
    Color color;
    std::optional<Pen> edge;
  };
  SolidView view_;
  std::vector<Face> faces_;
};

}  // namespace fairway::reproduce
