#include "check/shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace fairway_check {
namespace {

constexpr double alike = 0x1p-44;
constexpr int simple_corners = 48;
constexpr int roomy = Shape::most - 32;  // leaves room for clipping

/// Edges by angle, from east counterclockwise: first those that go up or due east.
bool goes_back(Point v) { return v.y < 0.0 || (v.y == 0.0 && v.x < 0.0); }
/// Not of edges that are parallel within rounding: those are walked together.
bool turns_before(Point a, Point b) {
  const double size = (std::abs(a.x) + std::abs(a.y)) * (std::abs(b.x) + std::abs(b.y));
  const double turn = cross(a, b);
  if (std::abs(turn) <= alike * size && a.x * b.x + a.y * b.y > 0.0) return false;
  return goes_back(a) != goes_back(b) ? goes_back(b) : turn > 0.0;
}

/// The lowest corner, of equally low ones the leftmost: there the edges begin.
int lowest(std::span<const Point> p) {
  const auto below = [](Point a, Point b) { return a.y < b.y || (a.y == b.y && a.x < b.x); };
  return static_cast<int>(std::min_element(p.begin(), p.end(), below) - p.begin());
}

/// The corners of one, in turn, from the lowest.
struct Walk {
  explicit Walk(const Shape& shape) : p(shape.corners()), first(lowest(p)) {}
  bool done() const { return steps == static_cast<int>(p.size()) || p.size() == 1; }
  Point corner() const { return p[static_cast<std::size_t>(first + steps) % p.size()]; }
  Point edge() const {
    return p[static_cast<std::size_t>(first + steps + 1) % p.size()] - corner();
  }
  std::span<const Point> p;
  int first;
  int steps = 0;
};

/// A polygon of `simple_corners` directions around it.
Shape around(std::span<const Point> all) {
  constexpr double step = 2.0 * std::numbers::pi / simple_corners;
  std::array<double, simple_corners + 1> reach{};
  const auto direction = [](int i) { return Point{std::cos(i * step), std::sin(i * step)}; };
  for (int i = 0; i <= simple_corners; ++i) {
    const Point n = direction(i);
    double most = -HUGE_VAL;
    for (const Point p : all) most = std::max(most, n.x * p.x + n.y * p.y);
    reach[static_cast<std::size_t>(i)] = most + 0x1p-38;
  }
  Shape simple;
  for (int i = 0; i < simple_corners; ++i) {  // where the i-th line meets the next one
    const Point n = direction(i);
    const double along = (reach[static_cast<std::size_t>(i) + 1] -
                          reach[static_cast<std::size_t>(i)] * std::cos(step)) /
                         std::sin(step);
    simple.add(reach[static_cast<std::size_t>(i)] * n + along * Point{-n.y, n.x});
  }
  return simple;
}

/// Keeps what is left of x <= limit, where x = sign * one coordinate.
template <double Point::*coordinate>
void cut(Shape& a, double sign, double limit) {
  Shape kept;
  const auto p = a.corners();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point from = p[i];
    const Point to = p[i + 1 < p.size() ? i + 1 : 0];
    const double before = limit - sign * (from.*coordinate);
    const double after = limit - sign * (to.*coordinate);
    if (before >= 0.0) kept.add(from);
    if ((before < 0.0) != (after < 0.0) && p.size() > 1) {
      Point at = from + before / (before - after) * (to - from);
      at.*coordinate = sign * limit;
      kept.add(at);
    }
  }
  a = kept;
}

}  // namespace

void Shape::add(Point p) {
  const auto same = [p](Point q) {
    return std::abs(p.x - q.x) < alike && std::abs(p.y - q.y) < alike;
  };
  if (count_ > 0 && (same(at_[count_ - 1]) || same(at_[0]))) return;
  if (count_ == most) throw std::length_error("a polygon has too many corners");
  at_[count_++] = p;
}

Box Shape::bounds() const {
  Box box{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const Point p : corners()) {
    box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x),
           std::max(box.y1, p.y)};
  }
  return box;
}

Shape sum(const Shape& a, const Shape& b, Point shift) {
  Shape all;
  if (a.empty() || b.empty()) return all;
  if (a.count() + b.count() > roomy) {
    return a.count() > b.count() ? sum(around(a.corners()), b, shift)
                                 : sum(a, around(b.corners()), shift);
  }
  Walk one(a);
  Walk other(b);
  all.add(one.corner() + other.corner() + shift);
  while (!one.done() || !other.done()) {
    const bool take_one = other.done() || (!one.done() && !turns_before(other.edge(), one.edge()));
    const bool take_other =
        one.done() || (!other.done() && !turns_before(one.edge(), other.edge()));
    if (take_one) ++one.steps;
    if (take_other) ++other.steps;
    if (!one.done() || !other.done()) all.add(one.corner() + other.corner() + shift);
  }
  return all;
}

Shape clipped(const Shape& a, const Box& box) {
  const Box b = a.bounds();
  Shape kept = a;
  if (b.x1 > box.x1) cut<&Point::x>(kept, 1.0, box.x1);
  if (b.x0 < box.x0) cut<&Point::x>(kept, -1.0, -box.x0);
  if (b.y1 > box.y1) cut<&Point::y>(kept, 1.0, box.y1);
  if (b.y0 < box.y0) cut<&Point::y>(kept, -1.0, -box.y0);
  return kept;
}

Shape hull(const Shape& a, const Shape& b) {
  std::array<Point, 2 * Shape::most> all;
  const auto end = std::copy(b.corners().begin(), b.corners().end(),
                             std::copy(a.corners().begin(), a.corners().end(), all.begin()));
  std::sort(all.begin(), end,
            [](Point p, Point q) { return p.x < q.x || (p.x == q.x && p.y < q.y); });
  // Andrew's monotone chain: along the bottom, then back along the top.
  std::array<Point, 4 * Shape::most> chain;
  std::size_t n = 0;
  const auto extend = [&](Point p, std::size_t floor) {
    while (n >= floor + 2 && cross(chain[n - 1] - chain[n - 2], p - chain[n - 1]) <= 0.0) --n;
    chain[n++] = p;
  };
  for (auto p = all.begin(); p != end; ++p) extend(*p, 0);
  const std::size_t bottom = n - 1;
  for (auto p = end; p != all.begin();) extend(*--p, bottom);
  n = std::max<std::size_t>(n, 2) - 1;  // the last is the first
  if (n > roomy) return around({chain.data(), n});
  Shape found;
  for (std::size_t i = 0; i < n; ++i) found.add(chain[i]);
  return found;
}

}  // namespace fairway_check
