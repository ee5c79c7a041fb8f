// A set of places by its bounds in four directions: what sets fly as where an answer is wanted in a
// microsecond. It holds the exact set, as a ConvexSet does; sums of such sets keep their bounds
// exactly, and cost a few additions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "fairway/base/vec2.hpp"

namespace fairway {

struct Octagon {
  static constexpr std::size_t directions = 4;

  // Of x, x + y, y and y - x.
  std::array<double, directions> lo;
  std::array<double, directions> hi;

  static std::array<double, directions> measures(Vec2 p) {
    return {p.x, p.x + p.y, p.y, p.y - p.x};
  }
  static Octagon empty() {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    return {{infinite, infinite, infinite, infinite}, {-infinite, -infinite, -infinite, -infinite}};
  }
  /// All that is at most `by` away from `p`, along either axis.
  static Octagon about(Vec2 p, double by) {
    const auto m = measures(p);
    return {{m[0] - by, m[1] - 2.0 * by, m[2] - by, m[3] - 2.0 * by},
            {m[0] + by, m[1] + 2.0 * by, m[2] + by, m[3] + 2.0 * by}};
  }
  /// The square with its lower left corner at (x, y), and what is at most `by` away from it.
  static Octagon square(double x, double y, double by) {
    return {{x - by, x + y - 2.0 * by, y - by, y - x - 1.0 - 2.0 * by},
            {x + 1.0 + by, x + y + 2.0 + 2.0 * by, y + 1.0 + by, y - x + 1.0 + 2.0 * by}};
  }

  bool is_empty() const { return lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2] || lo[3] > hi[3]; }
  /// Makes it hold `other`, too.
  void hold(const Octagon& other) {
    for (std::size_t k = 0; k < directions; ++k) {
      lo[k] = std::min(lo[k], other.lo[k]);
      hi[k] = std::max(hi[k], other.hi[k]);
    }
  }
  /// What lies in both; bounds that follow from others are made as tight.
  Octagon within(const Octagon& other) const {
    Octagon made;
    for (std::size_t k = 0; k < directions; ++k) {
      made.lo[k] = std::max(lo[k], other.lo[k]);
      made.hi[k] = std::min(hi[k], other.hi[k]);
    }
    auto& [x0, s0, y0, d0] = made.lo;
    auto& [x1, s1, y1, d1] = made.hi;
    s0 = std::max(s0, x0 + y0);
    s1 = std::min(s1, x1 + y1);
    d0 = std::max(d0, y0 - x1);
    d1 = std::min(d1, y1 - x0);
    x0 = std::max(x0, 0.5 * (s0 - d1));
    x1 = std::min(x1, 0.5 * (s1 - d0));
    y0 = std::max(y0, 0.5 * (s0 + d0));
    y1 = std::min(y1, 0.5 * (s1 + d1));
    return made;
  }
};

}  // namespace fairway
