#include "fairway/field/mission_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway {
namespace {

using Cells = std::set<std::uint32_t>;

// Samples of a line closer than this to a cell's side may fall on either side of it.
constexpr double rounding_cells = 1e-9;

std::vector<Grid> some_grids() {
  return {{1, 1, 0.0, 0.0, 1.0},      {1, 30, -3.0, 2.0, 0.5},    {30, 1, 5.0, -7.0, 2.0},
          {24, 17, -31.7, 12.3, 1.3}, {40, 40, 5e5, 4.2e6, 0.05}, {20, 20, 0.0, 0.0, 8.0}};
}

Vec2 somewhere(Random& random, const Grid& g, double beyond = 0.0) {
  return {g.x0_m + random.uniform(-beyond, 1.0 + beyond) * g.width_m(),
          g.y0_m + random.uniform(-beyond, 1.0 + beyond) * g.height_m()};
}

// --- The goal disc -------------------------------------------------------------------------------

// How far the farthest point of a cell is from the centre, over 4 x 4 points of each side.
double farthest_sampled(const Grid& g, Cell c, Vec2 center) {
  double far = 0.0;
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) {
      const Vec2 p = g.corner(c) + g.cell_m * Vec2{i / 4.0, j / 4.0};
      far = std::max(far, norm(p - center));
    }
  }
  return far;
}

TEST(CellsInsideDisc, AreThoseWhoseEveryPointIsInTheDisc) {
  Random random(61);
  int found_some = 0;
  for (const Grid& g : some_grids()) {
    for (int draw = 0; draw < 40; ++draw) {
      const Vec2 center = somewhere(random, g, 0.3);
      const double radius = random.uniform(0.0, 8.0) * g.cell_m;
      const std::vector<std::uint32_t> found = cells_inside_disc(g, center, radius);
      ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
      const Cells inside(found.begin(), found.end());
      ASSERT_EQ(inside.size(), found.size());
      found_some += inside.empty() ? 0 : 1;
      for (std::uint32_t i = 0; i < g.size(); ++i) {
        const double far = farthest_sampled(g, g.cell_at(i), center);
        if (std::fabs(far - radius) < 1e-8 * g.cell_m) continue;
        ASSERT_EQ(inside.count(i) == 1, far < radius) << "cell " << i << ", disc at " << center.x
                                                      << ", " << center.y << ", radius " << radius;
      }
    }
  }
  EXPECT_GT(found_some, 40);
}

TEST(CellsInsideDisc, TheClosedDiscHoldsACellWhoseCornersLieOnItsRim) {
  const Grid g{12, 12, 0.0, 0.0, 1.0};
  // About the corner (6, 6): the farthest corner of a cell is a (3, 4) away, exactly 5.
  const std::vector<std::uint32_t> found = cells_inside_disc(g, {6.0, 6.0}, 5.0);
  EXPECT_TRUE(std::binary_search(found.begin(), found.end(), g.index({8, 9})));
  EXPECT_TRUE(std::binary_search(found.begin(), found.end(), g.index({2, 3})));
  EXPECT_FALSE(std::binary_search(found.begin(), found.end(), g.index({9, 9})));
}

TEST(CellsInsideDisc, AboutACornerOfCellsTheAnswerIsSymmetric) {
  const Grid g{20, 20, 0.0, 0.0, 0.1};
  const std::vector<std::uint32_t> found = cells_inside_disc(g, {1.0, 1.0}, 0.55);
  EXPECT_EQ(found.size() % 4, 0U);
  EXPECT_FALSE(found.empty());
  for (const std::uint32_t i : found) {
    const Cell c = g.cell_at(i);
    for (const Cell image : {Cell{19 - c.ix, c.iy}, Cell{c.ix, 19 - c.iy}, Cell{c.iy, c.ix}}) {
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), g.index(image)));
    }
  }
}

TEST(CellsInsideDisc, ADiscTooSmallOrFarAwayHoldsNoCell) {
  const Grid g{10, 10, 0.0, 0.0, 1.0};
  EXPECT_TRUE(cells_inside_disc(g, {5.5, 5.5}, 0.70).empty());
  EXPECT_EQ(cells_inside_disc(g, {5.5, 5.5}, 0.71).size(), 1U);
  EXPECT_TRUE(cells_inside_disc(g, {5.5, 5.5}, 0.0).empty());
  EXPECT_TRUE(cells_inside_disc(g, {1e7, -1e7}, 3.0).empty());
  EXPECT_EQ(cells_inside_disc(g, {5.5, 5.5}, 1e6).size(), g.size());
}

// --- The path ------------------------------------------------------------------------------------

std::vector<std::pair<Vec2, Vec2>> pieces(const PathMission& path) {
  std::vector<std::pair<Vec2, Vec2>> out;
  for (std::size_t k = 0; k + 1 < path.vertices_m.size(); ++k) {
    out.emplace_back(path.vertices_m[k], path.vertices_m[k + 1]);
  }
  if (path.closed) out.emplace_back(path.vertices_m.back(), path.vertices_m.front());
  return out;
}

double to_segment(Vec2 a, Vec2 b, Vec2 p) {
  const double n = norm2(b - a);
  const double t = n == 0.0 ? 0.0 : std::clamp(dot(p - a, b - a) / n, 0.0, 1.0);
  return norm(p - (a + t * (b - a)));
}

double to_path(const PathMission& path, Vec2 p) {
  double d = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : pieces(path)) d = std::min(d, to_segment(a, b, p));
  return d;
}

// Does the segment pass the closed square, widened by `margin`? Clipping against its four sides.
bool passes(Vec2 a, Vec2 b, Vec2 low, Vec2 high, double margin) {
  double from = 0.0;
  double to = 1.0;
  for (const bool x : {true, false}) {
    const double start = x ? a.x : a.y;
    const double step = x ? b.x - a.x : b.y - a.y;
    const double lo = (x ? low.x : low.y) - margin;
    const double hi = (x ? high.x : high.y) + margin;
    if (step == 0.0) {
      if (start < lo || start > hi) return false;
      continue;
    }
    const double t1 = (lo - start) / step;
    const double t2 = (hi - start) / step;
    from = std::max(from, std::min(t1, t2));
    to = std::min(to, std::max(t1, t2));
  }
  return from <= to;
}

PathMission random_path(Random& random, const Grid& g) {
  PathMission path;
  const std::size_t count = 2 + random.below(6);
  path.closed = random.below(2) == 1;
  for (std::size_t k = 0; k < count; ++k) path.vertices_m.push_back(somewhere(random, g));
  if (random.below(3) == 0) {  // along the lines between cells, and through their corners
    for (Vec2& p : path.vertices_m) p = g.corner(g.cell_of(p));
  }
  if (random.below(4) == 0) path.vertices_m.push_back(path.vertices_m.back());  // a repeated vertex
  return path;
}

TEST(CellsOnPath, AreAllCellsThatTheClosedSquaresMeet) {
  Random random(62);
  for (const Grid& g : some_grids()) {
    for (int draw = 0; draw < 60; ++draw) {
      const PathMission path = random_path(random, g);
      const std::vector<PathCell> found = cells_on_path(g, path);
      std::map<std::uint32_t, PathCell> listed;
      for (const PathCell& c : found) listed[c.index] = c;
      ASSERT_EQ(listed.size(), found.size());
      ASSERT_TRUE(std::is_sorted(found.begin(), found.end(),
                                 [](const auto& a, const auto& b) { return a.index < b.index; }));
      // Coordinates of 4e6 m are known to 5e-10 m.
      const double unsure =
          rounding_cells * g.cell_m + 1e-15 * (std::fabs(g.x0_m) + std::fabs(g.y0_m));
      for (std::uint32_t i = 0; i < g.size(); ++i) {
        const Vec2 low = g.corner(g.cell_at(i));
        const Vec2 high = g.corner({g.cell_at(i).ix + 1, g.cell_at(i).iy + 1});
        bool inner = false;
        bool outer = false;
        for (const auto& [a, b] : pieces(path)) {
          if (a == b) continue;
          inner = inner || passes(a, b, low, high, -unsure);
          outer = outer || passes(a, b, low, high, unsure);
        }
        ASSERT_TRUE(!inner || listed.count(i) == 1U) << "cell " << i << " is missing, " << draw;
        ASSERT_TRUE(outer || listed.count(i) == 0U) << "cell " << i << " is off, draw " << draw;
      }
    }
  }
}

TEST(CellsOnPath, EveryCellThatADenseSamplingVisitsIsListed) {
  Random random(63);
  const Grid g{50, 40, -7.0, 3.0, 0.7};
  for (int draw = 0; draw < 40; ++draw) {
    const PathMission path = random_path(random, g);
    Cells listed;
    for (const PathCell& c : cells_on_path(g, path)) listed.insert(c.index);
    for (const auto& [a, b] : pieces(path)) {
      for (int k = 0; k <= 4000; ++k) {
        const Vec2 p = a + (k / 4000.0) * (b - a);
        const Cell c = g.cell_of(p);
        const Vec2 in_cell = (1.0 / g.cell_m) * (p - g.corner(c));
        const auto sure = [](double x) { return x > rounding_cells && x < 1.0 - rounding_cells; };
        if (!g.contains(c) || !sure(in_cell.x) || !sure(in_cell.y) || a == b) continue;
        ASSERT_EQ(listed.count(static_cast<std::uint32_t>(g.index(c))), 1U) << "draw " << draw;
      }
    }
  }
}

TEST(CellsOnPath, EachKnowsItsNearestPieceAndTheTangentThere) {
  Random random(64);
  for (const Grid& g : some_grids()) {
    for (int draw = 0; draw < 40; ++draw) {
      const PathMission path = random_path(random, g);
      const double unsure =
          rounding_cells * g.cell_m + 1e-15 * (std::fabs(g.x0_m) + std::fabs(g.y0_m));
      for (const PathCell& c : cells_on_path(g, path)) {
        const Cell cell = g.cell_at(c.index);
        const Vec2 center = g.center(cell);
        const Vec2 low = g.corner(cell);
        const Vec2 high = g.corner({cell.ix + 1, cell.iy + 1});
        ASSERT_NEAR(norm(c.tangent), 1.0, 1e-12);
        ASSERT_LE(c.distance_m, g.cell_m * 0.70711 * (1.0 + 1e-6));
        bool fits = false;
        for (const auto& [a, b] : pieces(path)) {
          if (a == b) continue;
          const double d = to_segment(a, b, center);
          ASSERT_TRUE(c.distance_m <= d + 1e-8 || !passes(a, b, low, high, -unsure));
          fits = fits || (std::fabs(c.distance_m - d) < 1e-8 && passes(a, b, low, high, unsure) &&
                          norm(c.tangent - (1.0 / norm(b - a)) * (b - a)) < 1e-9);
        }
        ASSERT_TRUE(fits) << "cell " << c.index << ", draw " << draw;
      }
    }
  }
}

TEST(CellsOnPath, AreConnectedBySidesAndCorners) {
  Random random(65);
  const Grid g{60, 60, 0.0, 0.0, 1.0};
  for (int draw = 0; draw < 60; ++draw) {
    Cells left;
    for (const PathCell& c : cells_on_path(g, random_path(random, g))) left.insert(c.index);
    if (left.empty()) continue;
    std::queue<std::uint32_t> open;
    open.push(*left.begin());
    left.erase(left.begin());
    while (!open.empty()) {
      const Cell c = g.cell_at(open.front());
      open.pop();
      for (int k = 0; k < 9; ++k) {
        const Cell n{c.ix + k % 3 - 1, c.iy + k / 3 - 1};
        if (!g.contains(n)) continue;
        const auto i = static_cast<std::uint32_t>(g.index(n));
        if (left.erase(i) == 1) open.push(i);
      }
    }
    EXPECT_TRUE(left.empty()) << left.size() << " cells apart, draw " << draw;
  }
}

TEST(CellsOnPath, AlongALineBetweenCellsBothSidesCount) {
  const Grid g{6, 6, 0.0, 0.0, 1.0};
  const auto listed = [&](Vec2 a, Vec2 b) {
    Cells out;
    for (const PathCell& c : cells_on_path(g, {{a, b}, false})) out.insert(c.index);
    return out;
  };
  Cells expected;
  for (int ix = 1; ix <= 4; ++ix) {  // x from 2 to 4 also touches the cells next to its ends
    for (const int iy : {2, 3}) expected.insert(static_cast<std::uint32_t>(g.index({ix, iy})));
  }
  EXPECT_EQ(listed({2.0, 3.0}, {4.0, 3.0}), expected);
  // A diagonal through corners meets four cells at each.
  EXPECT_EQ(listed({0.0, 0.0}, {6.0, 6.0}).size(), 6U + 2U * 5U);
  // The map's own rim belongs to its outer cells.
  EXPECT_EQ(listed({0.0, 6.0}, {6.0, 6.0}).size(), 6U);
  EXPECT_EQ(listed({6.0, 0.0}, {6.0, 6.0}).size(), 6U);
}

TEST(CellsOnPath, APathWithoutLengthOrOutsideTheGridHasNoCells) {
  const Grid g{6, 6, 0.0, 0.0, 1.0};
  EXPECT_TRUE(cells_on_path(g, {{{2.5, 2.5}, {2.5, 2.5}}, true}).empty());
  EXPECT_THROW((void)cells_on_path(g, {{}, false}), PreconditionViolation);
  EXPECT_TRUE(cells_on_path(g, {{{-5.0, 1.0}, {-1.0, 5.0}}, false}).empty());
  EXPECT_TRUE(cells_on_path(g, {{{7.0, 1.0}, {9.0, 1.0}}, false}).empty());
  EXPECT_TRUE(cells_on_path(g, {{{1.0, 8.0}, {1.0, 7.0}}, false}).empty());
}

TEST(CellsNearPath, AreThoseOfThePathAndTheirNeighboursWithDistancesToPieces) {
  Random random(67);
  for (const Grid& g : some_grids()) {
    for (int draw = 0; draw < 30; ++draw) {
      const PathMission path = random_path(random, g);
      Cells expected;
      for (const PathCell& c : cells_on_path(g, path)) {
        const Cell cell = g.cell_at(c.index);
        for (int k = 0; k < 9; ++k) {
          const Cell n{cell.ix + k % 3 - 1, cell.iy + k / 3 - 1};
          if (g.contains(n)) expected.insert(static_cast<std::uint32_t>(g.index(n)));
        }
      }
      Cells found;
      for (const PathCell& c : cells_near_path(g, path)) {
        found.insert(c.index);
        const double exact = nearest_on_path(g.center(g.cell_at(c.index)), path).distance_m;
        ASSERT_GE(c.distance_m, exact - 1e-8);
        // A piece that passes within a cell of the centre reaches at most a neighbour.
        if (exact < g.cell_m) {
          ASSERT_NEAR(c.distance_m, exact, 1e-8) << "cell " << c.index << ", draw " << draw;
        }
      }
      ASSERT_EQ(found, expected);
    }
  }
}

TEST(NearestOnPath, IsNoFartherThanAnySampleAndAtItsOwnArcLength) {
  Random random(66);
  const Grid g{30, 20, -4.0, 9.0, 1.5};
  for (int draw = 0; draw < 60; ++draw) {
    const PathMission path = random_path(random, g);
    double total = 0.0;
    for (const auto& [a, b] : pieces(path)) total += norm(b - a);
    if (total == 0.0) continue;
    for (int k = 0; k < 20; ++k) {
      const Vec2 p = somewhere(random, g, 0.4);
      const PathPoint near = nearest_on_path(p, path);
      ASSERT_NEAR(near.distance_m, to_path(path, p), 1e-10);
      ASSERT_GE(near.along_m, 0.0);
      ASSERT_LE(near.along_m, total + 1e-9);
      // Walk along_m along the path: that is the point.
      double left = near.along_m;
      bool found = false;
      for (const auto& [a, b] : pieces(path)) {
        const double length = norm(b - a);
        if (length > 0.0 && left <= length + 1e-9) {
          const Vec2 tangent = (1.0 / length) * (b - a);
          found = std::fabs(norm(p - (a + left * tangent)) - near.distance_m) < 1e-8 &&
                  norm(tangent - near.tangent.unit()) < 1e-9;
          if (found || left < length - 1e-9) break;
        }
        left -= length;
      }
      ASSERT_TRUE(found) << "draw " << draw;
    }
  }
}

TEST(NearestOnPath, OfEquallyNearPointsTheFirstCounts) {
  const PathMission hairpin{{{0.0, 0.0}, {10.0, 0.0}, {10.0, 4.0}, {0.0, 4.0}}, false};
  const PathPoint near = nearest_on_path({3.0, 2.0}, hairpin);
  EXPECT_EQ(near.distance_m, 2.0);
  EXPECT_EQ(near.along_m, 3.0);
  EXPECT_EQ(near.tangent.rad(), 0.0);
}

TEST(NearestOnPath, AClosedPathRunsHomeByItsLastPiece) {
  const PathMission square{{{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}}, true};
  const PathPoint near = nearest_on_path({-1.0, 4.0}, square);
  EXPECT_EQ(near.distance_m, 1.0);
  EXPECT_EQ(near.along_m, 36.0);
  EXPECT_EQ(near.tangent.rad(), -pi / 2);
}

TEST(CellsOnPath, KnowHowFarTheEndOfAnOpenPathIs) {
  Random random(66);
  for (int draw = 0; draw < 60; ++draw) {
    const Grid grid{40, 40, -3.0, 5.0, 1.5};
    PathMission path;
    for (int k = 0; k < 4; ++k) path.vertices_m.push_back(somewhere(random, grid));
    for (const PathCell& cell : cells_on_path(grid, path)) {
      // Along the path from the point of the cell's piece that is nearest to its centre: no other
      // point of the path at that distance from the end is nearer to the centre than this one.
      const double along_m = length_of(path) - cell.to_end_m;
      double before_m = 0.0;
      double nearest_m = std::numeric_limits<double>::infinity();
      for_pieces(path, [&](const PathPiece& piece) {
        const double t_m = along_m - before_m;
        before_m += piece.length_m;
        if (t_m < -1e-9 || t_m > piece.length_m + 1e-9) return;
        nearest_m =
            std::min(nearest_m, norm(piece.at(t_m) - grid.center(grid.cell_at(cell.index))));
      });
      ASSERT_NEAR(nearest_m, cell.distance_m, 1e-6) << "draw " << draw;
    }
    path.closed = true;
    for (const PathCell& cell : cells_on_path(grid, path)) {
      EXPECT_EQ(cell.to_end_m, std::numeric_limits<double>::infinity());
    }
  }
}

}  // namespace
}  // namespace fairway
