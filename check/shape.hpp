// Convex polygons of places, in doubles. Every operation errs by less than 2^-40 where coordinates
// stay below 2^13, so after a thousand of them each place that should be in a polygon is within
// 2^-30 of it (docs/trust.md, "The second theorem").
#pragma once

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <stdexcept>

namespace fairway_check {

struct Point {
  double x;
  double y;
};
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(double k, Point a) { return {k * a.x, k * a.y}; }
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

inline constexpr double alike = 0x1p-44;
inline bool are_alike(Point p, Point q) {
  return std::abs(p.x - q.x) < alike && std::abs(p.y - q.y) < alike;
}

struct Box {
  double x0;
  double y0;
  double x1;
  double y1;
  Box grown(double by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
};

/// Corners counterclockwise; also a point or a segment. Copies only the corners that exist.
class Shape {
 public:
  static constexpr int most = 160;

  Shape() = default;
  Shape(std::initializer_list<Point> corners) {
    for (const Point p : corners) add(p);
  }
  Shape(const Shape& other) { take(other); }
  Shape& operator=(const Shape& other) {
    if (this != &other) take(other);
    return *this;
  }
  ~Shape() = default;

  bool empty() const { return count_ == 0; }
  int count() const { return count_; }
  void clear() { count_ = 0; }
  /// Corners closer than 2^-44 to the last one are left out.
  void add(Point p) {
    if (count_ > 0 && (are_alike(p, at_[count_ - 1]) || are_alike(p, at_[0]))) return;
    if (count_ == most) throw std::length_error("a polygon has too many corners");
    at_[count_++] = p;
  }
  std::span<const Point> corners() const { return {at_, static_cast<std::size_t>(count_)}; }
  Box bounds() const;

 private:
  void take(const Shape& other) {
    count_ = other.count_;
    for (int i = 0; i < count_; ++i) at_[i] = other.at_[i];
  }
  int count_ = 0;
  Point at_[most];  // NOLINT: left unset beyond the count
};

/// All a + b + shift; with over 128 corners, first a polygon of 48 directions around the larger.
Shape sum(const Shape& a, const Shape& b, Point shift = {0.0, 0.0});

/// The part in a box; empty when they do not meet.
Shape clipped(const Shape& a, const Box& box);

/// Whether they meet: `clipped` gives some corner.
bool meets(const Shape& a, const Box& box);

/// The convex hull of two.
Shape hull(const Shape& a, const Shape& b);

}  // namespace fairway_check
