#include "fairway/inclusion/convex_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

constexpr std::size_t most_points = ConvexSet::capacity * 16;

double turn(Vec2 o, Vec2 a, Vec2 b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
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
    made.add({(reach[k] * toward[l].y - reach[l] * toward[k].y) / across,
              (toward[k].x * reach[l] - toward[l].x * reach[k]) / across});
  }
  return made;
}

ConvexSet ConvexSet::hull(std::span<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points = points.first(
      static_cast<std::size_t>(std::unique(points.begin(), points.end()) - points.begin()));
  // Andrew's monotone chain.
  std::array<Vec2, 2 * most_points> chain;
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

ConvexSet ConvexSet::below(double a, double b, double c) const {
  ConvexSet made;
  for (std::size_t i = 0; i < size_; ++i) {
    const Vec2 p = corner_[i];
    const Vec2 q = corner_[(i + 1) % size_];
    const double at_p = a * p.x + b * p.y - c;
    const double at_q = a * q.x + b * q.y - c;
    if (at_p <= 0.0) made.add(p);
    if ((at_p < 0.0 && at_q > 0.0) || (at_p > 0.0 && at_q < 0.0)) {
      const double t = at_p / (at_p - at_q);
      made.add({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  return made;
}

ConvexSet ConvexSet::within(Vec2 lowest, Vec2 highest) const {
  ConvexSet made = below(-1.0, 0.0, -lowest.x);
  if (!made.empty()) made = made.below(1.0, 0.0, highest.x);
  if (!made.empty()) made = made.below(0.0, -1.0, -lowest.y);
  if (!made.empty()) made = made.below(0.0, 1.0, highest.y);
  return made;
}

ConvexSet sum(const ConvexSet& set, std::span<const Vec2> steps) {
  require(steps.size() <= 16, "sum: at most 16 steps");
  std::array<Vec2, most_points> all;
  std::size_t n = 0;
  for (const Vec2 p : set.corners()) {
    for (const Vec2 step : steps) all[n++] = {p.x + step.x, p.y + step.y};
  }
  return ConvexSet::hull({all.data(), n});
}

}  // namespace fairway
