#include "check/shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fairway_check {
namespace {

constexpr int simple_corners = 48;
constexpr int roomy = Shape::most - 32;  // leaves room for clipping

/// Edges by angle, from east counterclockwise: first those that go up or due east.
bool goes_back(Point v) { return v.y < 0.0 || (v.y == 0.0 && v.x < 0.0); }
/// The lowest corner, of equally low ones the leftmost: there the edges begin.
int lowest(std::span<const Point> p) {
  const auto below = [](Point a, Point b) { return a.y < b.y || (a.y == b.y && a.x < b.x); };
  return static_cast<int>(std::min_element(p.begin(), p.end(), below) - p.begin());
}

/// The corners of one, in turn, from the lowest.
class Walk {
 public:
  explicit Walk(const Shape& shape)
      : p_(shape.corners()), at_(static_cast<std::size_t>(lowest(p_))), left_(shape.count()) {
    if (left_ == 1) left_ = 0;
    look();
  }
  bool done() const { return left_ == 0; }
  Point corner() const { return p_[at_]; }
  Point edge() const { return edge_; }
  bool goes_back() const { return goes_back_; }
  void step() {
    at_ = next();
    --left_;
    look();
  }

 private:
  std::size_t next() const { return at_ + 1 < p_.size() ? at_ + 1 : 0; }
  void look() {
    edge_ = p_[next()] - p_[at_];
    goes_back_ = fairway_check::goes_back(edge_);
  }

  std::span<const Point> p_;
  std::size_t at_;
  int left_;
  Point edge_{};
  bool goes_back_ = false;
};

/// Which of two edges comes first by its angle: positive for that of `a`, negative for that of `b`,
/// 0 where they are parallel within rounding: those are walked together.
double order_of(const Walk& a, const Walk& b) {
  const Point u = a.edge();
  const Point v = b.edge();
  const double turn = cross(u, v);
  const double size = (std::abs(u.x) + std::abs(u.y)) * (std::abs(v.x) + std::abs(v.y));
  if (std::abs(turn) <= alike * size && u.x * v.x + u.y * v.y > 0.0) return 0.0;
  if (a.goes_back() == b.goes_back()) return turn;
  return b.goes_back() ? 1.0 : -1.0;
}

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

/// Of `a`, what is left of x <= limit, where x = sign * one coordinate.
template <double Point::*coordinate>
void cut(const Shape& a, double sign, double limit, Shape& kept) {
  kept.clear();
  const auto p = a.corners();
  if (p.empty()) return;
  Point from = p.front();
  double before = limit - sign * (from.*coordinate);
  for (std::size_t i = 1; i <= p.size(); ++i) {  // of a single corner, it is the next one, too
    const Point to = p[i < p.size() ? i : 0];
    const double after = limit - sign * (to.*coordinate);
    if (before >= 0.0) kept.add(from);
    if ((before < 0.0) != (after < 0.0)) {
      Point at = from + before / (before - after) * (to - from);
      at.*coordinate = sign * limit;
      kept.add(at);
    }
    from = to;
    before = after;
  }
}

}  // namespace

Box Shape::bounds() const {
  // Of every other corner, so that the processor need not wait for each before the next.
  constexpr Box none{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  Box even = none;
  Box odd = none;
  const auto hold = [](Box& box, Point p) {
    box.x0 = std::min(box.x0, p.x);
    box.y0 = std::min(box.y0, p.y);
    box.x1 = std::max(box.x1, p.x);
    box.y1 = std::max(box.y1, p.y);
  };
  int i = 0;
  for (; i + 1 < count_; i += 2) {
    hold(even, at_[i]);
    hold(odd, at_[i + 1]);
  }
  if (i < count_) hold(even, at_[i]);
  return {std::min(even.x0, odd.x0), std::min(even.y0, odd.y0), std::max(even.x1, odd.x1),
          std::max(even.y1, odd.y1)};
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
    const double order = other.done() ? 1.0 : one.done() ? -1.0 : order_of(one, other);
    if (order >= 0.0) one.step();
    if (order <= 0.0) other.step();
    if (!one.done() || !other.done()) all.add(one.corner() + other.corner() + shift);
  }
  return all;
}

Shape clipped(const Shape& a, const Box& box) {
  const Box b = a.bounds();
  Shape kept;
  if (b.x0 > box.x1 || b.x1 < box.x0 || b.y0 > box.y1 || b.y1 < box.y0) return kept;
  // From one to the other and back, so that few corners are copied.
  Shape other;
  const Shape* last = &a;
  const auto keep = [&](bool is_needed, const auto& cut_to) {
    if (!is_needed) return;
    Shape& made = last == &kept ? other : kept;
    cut_to(made);
    last = &made;
  };
  keep(b.x1 > box.x1, [&](Shape& made) { cut<&Point::x>(*last, 1.0, box.x1, made); });
  keep(b.x0 < box.x0, [&](Shape& made) { cut<&Point::x>(*last, -1.0, -box.x0, made); });
  keep(b.y1 > box.y1, [&](Shape& made) { cut<&Point::y>(*last, 1.0, box.y1, made); });
  keep(b.y0 < box.y0, [&](Shape& made) { cut<&Point::y>(*last, -1.0, -box.y0, made); });
  if (last != &kept) kept = *last;
  return kept;
}

bool meets(const Shape& a, const Box& box) {
  const auto corners = a.corners();
  const bool holds_one = std::any_of(corners.begin(), corners.end(), [&box](Point p) {
    return p.x > box.x0 && p.x < box.x1 && p.y > box.y0 && p.y < box.y1;
  });
  return holds_one || !clipped(a, box).empty();
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
