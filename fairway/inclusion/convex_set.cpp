#include "fairway/inclusion/convex_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fairway {
namespace {

constexpr std::size_t most_points = ConvexSet::capacity * 16;

double turn(Vec2 o, Vec2 a, Vec2 b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// But for rounding.
bool are_parallel(Vec2 e, Vec2 f) {
  const double a = e.x * f.y;
  const double b = e.y * f.x;
  return std::abs(a - b) <= 1e-14 * (std::abs(a) + std::abs(b));
}
bool is_about(Vec2 a, Vec2 b) {
  const double size = 1.0 + std::max(std::abs(a.x), std::abs(a.y));
  return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) <= 0x1p-46 * size;
}

constexpr int directions = 16;
const std::array<Vec2, directions>& compass() {
  static const std::array<Vec2, directions> made = [] {
    std::array<Vec2, directions> all;
    for (int k = 0; k < directions; ++k) {
      const double angle = k * 3.14159265358979323846 / 8.0;
      all[static_cast<std::size_t>(k)] = {std::cos(angle), std::sin(angle)};
    }
    return all;
  }();
  return made;
}

}  // namespace

ConvexSet sum_of_ordered(const ConvexSet& set, const ConvexSet& step);

ConvexSet ConvexSet::of_directions(std::span<const Vec2> points) {
  const auto& toward = compass();
  std::array<double, directions> reach;
  for (std::size_t k = 0; k < directions; ++k) {
    reach[k] = -std::numeric_limits<double>::infinity();
    for (const Vec2 p : points) {
      reach[k] = std::max(reach[k], toward[k].x * p.x + toward[k].y * p.y);
    }
  }
  ConvexSet made;
  for (std::size_t k = 0; k < directions; ++k) {
    const std::size_t l = (k + 1) % directions;
    const double across = toward[k].x * toward[l].y - toward[k].y * toward[l].x;
    const Vec2 corner{(reach[k] * toward[l].y - reach[l] * toward[k].y) / across,
                      (toward[k].x * reach[l] - toward[l].x * reach[k]) / across};
    // Edges of no length but for rounding would point anywhere.
    if (made.size_ > 0 && is_about(corner, made.corner_[made.size_ - 1])) continue;
    made.add(corner);
  }
  if (made.size_ > 1 && is_about(made.corner_[0], made.corner_[made.size_ - 1])) --made.size_;
  return made;
}

ConvexSet ConvexSet::of_ordered(std::span<const Vec2> corners, bool counter_clockwise) {
  ConvexSet made;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    made.add(corners[counter_clockwise ? i : corners.size() - 1 - i]);
  }
  return made;
}

ConvexSet ConvexSet::hull(std::span<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points = points.first(
      static_cast<std::size_t>(std::unique(points.begin(), points.end()) - points.begin()));
  // Andrew's monotone chain.
  union Chain {
    Chain() {}  // NOLINT: the places stay uninitialised
    std::array<Vec2, 2 * most_points> places;
  } room;
  auto& chain = room.places;
  std::size_t n = 0;
  const auto push = [&](Vec2 p, std::size_t kept) {
    while (n >= kept && turn(chain[n - 2], chain[n - 1], p) <= 0.0) --n;
    chain[n++] = p;
  };
  for (const Vec2 p : points) push(p, 2);
  const std::size_t upper = n + 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) push(points[i], upper);
  if (n > 1) --n;  // the first again
  if (n > simple) return of_directions({chain.data(), n});
  ConvexSet made;
  for (std::size_t i = 0; i < n; ++i) made.add(chain[i]);
  return made;
}

/// Keeps what lies where `off`, a linear function of places, is at most 0.
template <typename Off>
void ConvexSet::keep_inside(const Off& off) {
  double distance[capacity];
  bool all = true;
  bool none = true;
  for (std::size_t i = 0; i < size_; ++i) {
    distance[i] = off(corner_[i]);
    all &= distance[i] <= 0.0;
    none &= distance[i] > 0.0;
  }
  if (all) return;
  if (none) {
    size_ = 0;
    return;
  }
  ConvexSet made;
  for (std::size_t i = 0; i < size_; ++i) {
    const std::size_t next = i + 1 < size_ ? i + 1 : 0;
    const double at_p = distance[i];
    const double at_q = distance[next];
    const Vec2 p = corner_[i];
    if (at_p <= 0.0) made.add(p);
    if ((at_p < 0.0 && at_q > 0.0) || (at_p > 0.0 && at_q < 0.0)) {
      const Vec2 q = corner_[next];
      const double t = at_p / (at_p - at_q);
      const Vec2 between{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
      if (!is_about(between, at_p < 0.0 ? p : q)) made.add(between);
    }
  }
  *this = made;
}

template <double Vec2::*along>
void ConvexSet::keep_above(double least) {
  keep_inside([least](Vec2 p) { return least - p.*along; });
}

template <double Vec2::*along>
void ConvexSet::keep_below(double most) {
  keep_inside([most](Vec2 p) { return p.*along - most; });
}

ConvexSet ConvexSet::within_x(double lo, double hi) const {
  ConvexSet made = *this;
  made.keep_above<&Vec2::x>(lo);
  made.keep_below<&Vec2::x>(hi);
  return made;
}

ConvexSet ConvexSet::within_y(double lo, double hi) const {
  ConvexSet made = *this;
  made.keep_above<&Vec2::y>(lo);
  made.keep_below<&Vec2::y>(hi);
  return made;
}

Box ConvexSet::box() const {
  Box box{corner_[0], corner_[0]};
  for (std::size_t i = 1; i < size_; ++i) {
    const Vec2 p = corner_[i];
    box.lowest = {std::min(box.lowest.x, p.x), std::min(box.lowest.y, p.y)};
    box.highest = {std::max(box.highest.x, p.x), std::max(box.highest.y, p.y)};
  }
  return box;
}

std::size_t ConvexSet::lowest_corner() const {
  std::size_t at = 0;
  for (std::size_t i = 1; i < size_; ++i) {
    const Vec2 p = corner_[i];
    const Vec2 q = corner_[at];
    if (p.y < q.y || (p.y == q.y && p.x < q.x)) at = i;
  }
  return at;
}

/// Whether every edge turns left of the one before, or goes on along it. Rounding can move a corner
/// inwards by its last bits; where corners lie close, directions are then far off.
bool ConvexSet::turns_left() const {
  if (size_ < 3) return true;
  Vec2 before = corner_[0] - corner_[size_ - 1];
  for (std::size_t i = 0; i < size_; ++i) {
    const Vec2 edge = corner_[i + 1 < size_ ? i + 1 : 0] - corner_[i];
    const double across = cross(before, edge);
    if (!(across > 0.0) && !(are_parallel(before, edge) && dot(before, edge) > 0.0)) return false;
    before = edge;
  }
  return true;
}

/// From its lowest corner, a sum goes along the edges of both, in the order of their directions.
ConvexSet sum(const ConvexSet& set, const ConvexSet& step) {
  if (set.empty() || step.empty()) return {};
  const auto ordered = [](ConvexSet s) {
    return s.turns_left() ? s : ConvexSet::hull({s.corner_, s.size_});
  };
  return sum_of_ordered(ordered(set), ordered(step));
}

ConvexSet sum_of_ordered(const ConvexSet& set, const ConvexSet& step) {
  const std::size_t n = set.size_;
  const std::size_t m = step.size_;
  const std::size_t a = set.lowest_corner();
  const std::size_t b = step.lowest_corner();
  const auto edge = [](const ConvexSet& s, std::size_t from) {  // from < 2 size
    const std::size_t at = from < s.size_ ? from : from - s.size_;
    return s.corner_[at + 1 < s.size_ ? at + 1 : 0] - s.corner_[at];
  };
  union Corners {
    Corners() {}  // NOLINT: the places stay uninitialised
    std::array<Vec2, 2 * ConvexSet::capacity> places;
  } room;
  auto& corner = room.places;
  std::size_t count = 0;
  Vec2 at = set.corner_[a] + step.corner_[b];
  const std::size_t edges_a = n > 1 ? n : 0;
  const std::size_t edges_b = m > 1 ? m : 0;
  for (std::size_t i = 0, j = 0; i < edges_a || j < edges_b;) {
    if (count == 0 || !is_about(at, corner[count - 1])) corner[count++] = at;
    if (i == edges_a) {
      at = at + edge(step, b + j++);
    } else if (j == edges_b) {
      at = at + edge(set, a + i++);
    } else {
      const Vec2 e = edge(set, a + i);
      const Vec2 f = edge(step, b + j);
      // Both point upwards or both downwards when their turn decides.
      const bool up_e = e.y > 0.0 || (e.y == 0.0 && e.x > 0.0);
      const bool up_f = f.y > 0.0 || (f.y == 0.0 && f.x > 0.0);
      if (up_e != up_f) {
        at = at + (up_e ? e : f);
        ++(up_e ? i : j);
      } else if (are_parallel(e, f)) {
        at = at + e + f;
        ++i;
        ++j;
      } else {
        const bool first_e = cross(e, f) > 0.0;
        at = at + (first_e ? e : f);
        ++(first_e ? i : j);
      }
    }
  }
  if (count == 0) corner[count++] = at;
  if (count > ConvexSet::simple) return ConvexSet::of_directions({corner.data(), count});
  ConvexSet made;
  for (std::size_t i = 0; i < count; ++i) made.add(corner[i]);
  return made;
}

}  // namespace fairway
