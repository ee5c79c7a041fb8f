#include "fairway/map/simple_polygon.hpp"

#include <algorithm>
#include <cmath>

namespace fairway {

namespace {

struct Edge {
  Vec2 a, b;
  std::size_t ring, index, count;
};

// The sign of the turn a -> b -> c. Kahan's difference of products is accurate to 1.5 ulp, so its
// sign is that of the exact determinant of the (rounded) differences.
int turn(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 u = b - a;
  const Vec2 v = c - a;
  const double w = u.y * v.x;
  const double error = std::fma(-u.y, v.x, w);
  const double det = std::fma(u.x, v.y, -w) + error;
  return (det > 0.0) - (det < 0.0);
}

bool within_box(Vec2 a, Vec2 b, Vec2 p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

Vec2 crossing_point(const Edge& e, const Edge& f) {
  const Vec2 u = e.b - e.a;
  const Vec2 v = f.b - f.a;
  const double t = cross(f.a - e.a, v) / cross(u, v);
  return e.a + std::clamp(t, 0.0, 1.0) * u;
}

std::optional<Vec2> meeting(const Edge& e, const Edge& f, bool proper_only) {
  const int fa = turn(e.a, e.b, f.a);
  const int fb = turn(e.a, e.b, f.b);
  const int ea = turn(f.a, f.b, e.a);
  const int eb = turn(f.a, f.b, e.b);
  if (fa * fb < 0 && ea * eb < 0) return crossing_point(e, f);
  if (proper_only) return std::nullopt;
  if (fa == 0 && within_box(e.a, e.b, f.a)) return f.a;
  if (fb == 0 && within_box(e.a, e.b, f.b)) return f.b;
  if (ea == 0 && within_box(f.a, f.b, e.a)) return e.a;
  if (eb == 0 && within_box(f.a, f.b, e.b)) return e.b;
  return std::nullopt;
}

// Neighbours share a corner; they may not fold back on each other.
std::optional<Vec2> fold(const Edge& e, const Edge& next) {
  if (turn(e.a, e.b, next.b) != 0 || dot(e.b - e.a, next.b - next.a) >= 0.0) return std::nullopt;
  return e.b;
}

std::optional<Vec2> forbidden(const Edge& e, const Edge& f) {
  if (e.ring != f.ring) return meeting(e, f, true);
  const bool f_next = (e.index + 1) % e.count == f.index;
  const bool e_next = (f.index + 1) % f.count == e.index;
  if (f_next || e_next) {
    const auto folded = f_next ? fold(e, f) : std::nullopt;
    return folded ? folded : (e_next ? fold(f, e) : std::nullopt);
  }
  return meeting(e, f, false);
}

}  // namespace

std::optional<EdgeContact> find_contact(const std::vector<std::vector<Vec2>>& rings) {
  std::vector<Edge> edges;
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i)
      edges.push_back({rings[r][i], rings[r][(i + 1) % rings[r].size()], r, i, rings[r].size()});
  // Sweep along x: an edge is compared with those that still overlap it in x.
  const auto low_x = [](const Edge& e) { return std::min(e.a.x, e.b.x); };
  const auto high_x = [](const Edge& e) { return std::max(e.a.x, e.b.x); };
  std::stable_sort(edges.begin(), edges.end(),
                   [&](const Edge& e, const Edge& f) { return low_x(e) < low_x(f); });
  std::vector<const Edge*> active;
  for (const Edge& edge : edges) {
    std::erase_if(active, [&](const Edge* other) { return high_x(*other) < low_x(edge); });
    for (const Edge* other : active) {
      if (std::max(other->a.y, other->b.y) < std::min(edge.a.y, edge.b.y) ||
          std::min(other->a.y, other->b.y) > std::max(edge.a.y, edge.b.y))
        continue;
      const bool in_order = std::pair(other->ring, other->index) < std::pair(edge.ring, edge.index);
      const Edge& first = in_order ? *other : edge;
      const Edge& second = in_order ? edge : *other;
      if (const auto at = forbidden(first, second))
        return EdgeContact{first.ring, first.index, second.ring, second.index, *at};
    }
    active.push_back(&edge);
  }
  return std::nullopt;
}

}  // namespace fairway
