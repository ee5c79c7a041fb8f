#include "fairway/report/thinned_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

using Kind = DrawingPath::Kind;

/// Points of a path not farther apart than `step`, stretch by stretch.
std::vector<std::vector<Vec2>> samples_of(const DrawingPath& path, double step) {
  std::vector<std::vector<Vec2>> stretches;
  Vec2 here;
  const auto line_to = [&](Vec2 end) {
    const double n = std::max(1.0, std::ceil(norm(end - here) / step));
    for (double k = 1.0; k <= n; k += 1.0)
      stretches.back().push_back(here + (k / n) * (end - here));
    here = end;
  };
  for (const auto& piece : path.pieces()) {
    if (piece.kind == Kind::move) {
      stretches.push_back({piece.end});
      here = piece.end;
    } else if (piece.kind == Kind::line) {
      line_to(piece.end);
    } else if (piece.kind == Kind::close) {
      line_to(Vec2(stretches.back().front()));
    } else {
      const double n = std::ceil(std::abs(piece.sweep_rad) * piece.radius / step) + 8.0;
      for (double k = 1.0; k <= n; k += 1.0) {
        const double a = piece.from_rad + piece.sweep_rad * k / n;
        line_to(piece.center + piece.radius * Vec2{std::cos(a), std::sin(a)});
      }
    }
  }
  return stretches;
}

/// The farthest that a point of `from` is from all points of `to`.
double farthest(const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
  double most = 0.0;
  for (const Vec2 p : from) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec2 q : to) least = std::min(least, norm(p - q));
    most = std::max(most, least);
  }
  return most;
}

/// Lines, arcs and repeated points of sizes around the tolerance, 1; with loops and returns.
DrawingPath random_path(Random& random) {
  DrawingPath path;
  Vec2 here{random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0)};
  double heading = random.uniform(-pi, pi);
  path.move_to(here);
  for (std::uint64_t i = 0, n = 1 + random.below(60); i < n; ++i) {
    const double length = std::array{0.0, 1e-8, 0.3, 1.0, 4.0}[random.below(5)];
    switch (random.below(8)) {
      case 0:
        heading += random.uniform(-pi, pi);
        break;
      case 1:
        heading += pi;
        break;
      case 2:
        path.close();
        here = {random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0)};
        path.move_to(here);
        break;
      default:
        heading += random.uniform(-0.2, 0.2);
    }
    if (random.below(3) == 0) {
      const double radius = std::array{0.1, 1.0, 20.0}[random.below(3)];
      const double sweep = random.below(9) == 0 ? two_pi : length / radius;
      const Vec2 center = here + radius * Vec2{-std::sin(heading), std::cos(heading)};
      path.arc(center, radius, heading - 0.5 * pi, sweep);
      heading += sweep;
    } else {
      path.line_to(here + length * Vec2{std::cos(heading), std::sin(heading)});
    }
    here = path.pieces().back().end;
  }
  return path;
}

RC_GTEST_PROP(ThinnedPath, IsNowhereFartherAwayThanTheTolerance, (std::uint64_t seed)) {
  Random random(seed);
  const DrawingPath path = random_path(random);
  const DrawingPath thin = thinned(path, 1.0);
  RC_ASSERT(thin.pieces().size() <= path.pieces().size());
  constexpr double step = 0.05;
  const auto before = samples_of(path, step);
  const auto after = samples_of(thin, step);
  RC_ASSERT(before.size() == after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    RC_ASSERT(before[i].front() == after[i].front());
    RC_ASSERT(norm(before[i].back() - after[i].back()) < 1e-9);
    RC_ASSERT(farthest(before[i], after[i]) <= 1.0 + step);
    RC_ASSERT(farthest(after[i], before[i]) <= 1.0 + step);
  }
}

RC_GTEST_PROP(ThinnedPath, OfANarrowWeaveIsAFewLines, (std::uint64_t seed)) {
  Random random(seed);
  const double heading = random.uniform(-pi, pi);
  const Vec2 along{std::cos(heading), std::sin(heading)};
  DrawingPath path;
  path.move_to({3.0, 4.0});
  for (int i = 1; i <= 1000; ++i)
    path.line_to(Vec2{3.0, 4.0} + 0.5 * i * along +
                 random.uniform(-0.02, 0.02) * Vec2{-along.y, along.x});
  RC_ASSERT(thinned(path, 0.06).pieces().size() <= 3U);
}

TEST(ThinnedPath, KeepsACurveThatShowsAndFlattensOneThatDoesNot) {
  DrawingPath path;
  path.move_to({10.0, 0.0}).arc({0.0, 0.0}, 10.0, 0.0, 1.0);
  EXPECT_EQ(thinned(path, 0.05).pieces().back().kind, Kind::arc);
  EXPECT_EQ(thinned(path, 10.0).pieces().back().kind, Kind::line);
}

TEST(ThinnedPath, OfAnEmptyPathIsEmpty) { EXPECT_TRUE(thinned({}, 0.05).empty()); }

}  // namespace
}  // namespace fairway
