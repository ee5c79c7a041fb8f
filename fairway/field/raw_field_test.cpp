#include "fairway/field/raw_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "fairway/field/cost_to_go.hpp"
#include "fairway/field/distance_transform.hpp"
#include "fairway/field/testing/sample_maps.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway {
namespace {

using samples::Mask;

constexpr Vehicle vehicle{10.0, 4.0};

struct Steps {
  CompleteMap complete;
  std::vector<float> safe_start_cost;  ///< before the raw field added the buffer's
  std::vector<float> cost;
  BufferBorder nearest;  ///< before barred cells were given another
  BufferBorder border;
  VectorField field;
};

Steps steps_of(const ObstacleMap& map, const Mission& mission, Metric metric, double alpha = 1.0) {
  FieldOptions options;
  options.alpha = alpha;
  options.beta = 1.0;
  options.metric = metric;
  auto found = complete_map(map, vehicle, mission, options);
  const auto* refusal = std::get_if<MissionRefusal>(&found);
  if (refusal != nullptr) throw std::runtime_error(refusal->message);
  Steps s;
  s.complete = std::get<CompleteMap>(std::move(found));
  s.safe_start_cost = cost_to_go(map.grid, s.complete, mission, metric);
  s.cost = s.safe_start_cost;
  s.nearest = buffer_border(map.grid, s.complete.region, s.cost);
  s.border = s.nearest;
  s.field = raw_field(map.grid, s.complete, mission, metric, s.cost, s.border);
  return s;
}

Vec2 direction(const Steps& s, std::size_t i) { return {s.field.x[i], s.field.y[i]}; }

double angle_between(Vec2 a, Vec2 b) { return std::fabs(std::atan2(cross(a, b), dot(a, b))); }

ObstacleMap blob_map(Random& random) {
  Mask m = samples::blobs(random, 90, 80, 12, 5.0);
  for (int iy = 30; iy < 45; ++iy) {  // room for the goal
    for (int ix = 35; ix < 50; ++ix) m.at(ix, iy) = 0;
  }
  return samples::map_of(m, 1.0, -3.0, 8.0);
}

const GoalMission goal{{39.3, 45.6}, {}};

TEST(RawField, IsAUnitVectorExactlyWhereTheCostIsFinite) {
  Random random(101);
  for (int draw = 0; draw < 8; ++draw) {
    const ObstacleMap map = blob_map(random);
    for (const Metric metric : {Metric::euclidean, Metric::octile, Metric::paper}) {
      const Steps s = steps_of(map, goal, metric);
      for (std::size_t i = 0; i < s.cost.size(); ++i) {
        const double length = norm(direction(s, i));
        if (s.complete.region[i] == Region::obstacle) {
          ASSERT_TRUE(std::isinf(s.cost[i]));
          ASSERT_NEAR(length, metric == Metric::paper ? 1.0 : 0.0, 1e-6);
        } else {
          ASSERT_NEAR(length, std::isfinite(s.cost[i]) ? 1.0 : 0.0, 1e-6)
              << "cell " << i << ", draw " << draw;
        }
      }
    }
  }
}

// Bilinear interpolation between the four cell centres around a point given in cells.
double interpolated(const Grid& g, const std::vector<float>& cost, double x, double y) {
  const int ix = std::clamp(static_cast<int>(std::floor(x)), 0, g.nx - 2);
  const int iy = std::clamp(static_cast<int>(std::floor(y)), 0, g.ny - 2);
  const double u = x - ix;
  const double v = y - iy;
  const auto at = [&](int dx, int dy) {
    return static_cast<double>(cost[g.index({ix + dx, iy + dy})]);
  };
  return (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1));
}

TEST(RawField, ASmallStepAlongItLowersTheInterpolatedCost) {
  Random random(102);
  std::size_t looked_at = 0;
  for (int draw = 0; draw < 12; ++draw) {
    const ObstacleMap map = blob_map(random);
    const Grid& g = map.grid;
    const Steps s = steps_of(map, goal, Metric::euclidean);
    for (std::size_t i = 0; i < g.size(); ++i) {
      if (s.complete.region[i] != Region::free || !std::isfinite(s.cost[i])) continue;
      const Cell c = g.cell_at(i);
      const Vec2 step = 0.25 * direction(s, i);
      const double after = interpolated(g, s.safe_start_cost, c.ix + step.x, c.iy + step.y);
      if (!std::isfinite(after)) continue;  // next to the buffer there is nothing to interpolate
      ++looked_at;
      ASSERT_LT(after, s.cost[i]) << "cell " << c.ix << ", " << c.iy << ", draw " << draw;
    }
  }
  EXPECT_GT(looked_at, 20'000U);
}

TEST(RawField, OctileAndPaperTakeTheSteepestOfTheEightNeighbours) {
  Random random(103);
  for (int draw = 0; draw < 6; ++draw) {
    const ObstacleMap map = blob_map(random);
    const Grid& g = map.grid;
    for (const Metric metric : {Metric::octile, Metric::paper}) {
      const Steps s = steps_of(map, goal, metric);
      for (std::size_t i = 0; i < g.size(); ++i) {
        if (s.complete.region[i] != Region::free || !std::isfinite(s.cost[i])) continue;
        const double eighths = std::atan2(s.field.y[i], s.field.x[i]) / (pi / 4);
        ASSERT_NEAR(eighths, std::round(eighths), 1e-5) << "cell " << i;
        const Cell c = g.cell_at(i);
        const auto slope_to = [&](int dx, int dy) {
          const Cell n{c.ix + dx, c.iy + dy};
          if (!g.contains(n)) return -std::numeric_limits<double>::infinity();
          const double slanted = metric == Metric::paper ? 1.41 : std::sqrt(2.0);
          return (static_cast<double>(s.cost[i]) - s.safe_start_cost[g.index(n)]) /
                 (dx != 0 && dy != 0 ? slanted : 1.0);
        };
        double steepest = 0.0;
        for (int k = 0; k < 9; ++k) {
          if (k != 4) steepest = std::max(steepest, slope_to(k % 3 - 1, k / 3 - 1));
        }
        const double taken = slope_to(static_cast<int>(std::lround(s.field.x[i])),
                                      static_cast<int>(std::lround(s.field.y[i])));
        ASSERT_GT(taken, 0.0) << "cell " << i;
        ASSERT_NEAR(taken, steepest, 1e-4) << "cell " << i;
      }
    }
  }
}

TEST(RawField, InTheOpenItPointsToTheGoalWithinItsMeasuredErrorAndIsNotQuantised) {
  // Measured: worst 0.122, 0.062, 0.031 rad, mean 0.0092, 0.0053, 0.0027 rad for goal discs of 4,
  // 8, 16 cells, in more than 11,600 different directions of 13,200 cells.
  const ObstacleMap map = samples::map_of(Mask(120, 110), 1.0);
  const Grid& g = map.grid;
  const GoalMission point{{53.3, 61.9}, {}};
  for (const auto& [beta, bound] :
       std::vector<std::pair<double, double>>{{1.0, 0.125}, {2.0, 0.0625}, {4.0, 0.0315}}) {
    FieldOptions options;
    options.beta = beta;
    const auto complete = std::get<CompleteMap>(complete_map(map, vehicle, point, options));
    std::vector<float> cost = cost_to_go(g, complete, point, Metric::euclidean);
    BufferBorder border = buffer_border(g, complete.region, cost);
    const VectorField field = raw_field(g, complete, point, Metric::euclidean, cost, border);
    std::set<long> directions;
    double worst = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      const Vec2 f{field.x[i], field.y[i]};
      const double error = angle_between(f, point.goal_m - g.center(g.cell_at(i)));
      worst = std::max(worst, error);
      sum += error;
      directions.insert(std::lround(1e4 * std::atan2(f.y, f.x)));
    }
    EXPECT_LT(worst, bound) << "beta " << beta;
    EXPECT_LT(sum / static_cast<double>(g.size()), bound / 11.0) << "beta " << beta;
    EXPECT_GT(directions.size(), 11'000U);
  }
}

TEST(RawField, InTheGoalDiscItPointsToTheGoalAndNowhereIsItZero) {
  const ObstacleMap map = samples::map_of(Mask(40, 40), 1.0);
  for (const Vec2 at : {Vec2{20.5, 20.5}, Vec2{20.0, 20.0}, Vec2{19.7, 22.1}}) {
    const GoalMission point{at, {}};
    for (const Metric metric : {Metric::euclidean, Metric::octile, Metric::paper}) {
      const Steps s = steps_of(map, point, metric);
      for (const std::uint32_t i : s.complete.goal_cells) {
        const Vec2 way = at - map.grid.center(map.grid.cell_at(i));
        ASSERT_NEAR(norm(direction(s, i)), 1.0, 1e-6);
        ASSERT_TRUE(norm(way) == 0.0 || angle_between(direction(s, i), way) < 1e-6);
      }
    }
  }
}

TEST(RawField, PathCellsCarryTheTangent) {
  const ObstacleMap map = samples::map_of(Mask(60, 50), 1.0);
  const PathMission path{{{8.0, 8.0}, {50.0, 20.0}, {30.0, 44.0}, {9.0, 30.0}}, true};
  for (const Metric metric : {Metric::euclidean, Metric::octile, Metric::paper}) {
    const Steps s = steps_of(map, path, metric);
    ASSERT_FALSE(s.complete.path_cells.empty());
    for (const PathCell& c : s.complete.path_cells) {
      EXPECT_LT(norm(direction(s, c.index) - c.tangent), 1e-6);
    }
  }
}

TEST(RawField, TwoCellsOrMoreBesideAStraightPathItPointsToThePath) {
  const ObstacleMap map = samples::map_of(Mask(120, 110), 0.5, -7.0, 3.0);
  const Grid& g = map.grid;
  // Measured: 0.090, 0.094, 0.113, 0.119, 0.163 rad at worst.
  for (const double rise_m : {0.0, 0.4, 2.0, 7.0, 16.0}) {
    const PathMission line{{{-6.6, 25.0}, {52.6, 25.0 + rise_m}}, false};
    const Steps s = steps_of(map, line, Metric::euclidean);
    double worst = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      const Vec2 p = g.center(g.cell_at(i));
      const PathPoint near = nearest_on_path(p, line);
      if (near.distance_m < 2.0 * g.cell_m) continue;
      const Vec2 foot = near.position_m;
      worst = std::max(worst, angle_between(direction(s, i), foot - p));
    }
    EXPECT_LT(worst, 0.165) << "the line rises by " << rise_m << " m";
  }
}

// --- The buffer ----------------------------------------------------------------------------------

// Does the closed straight line between two centres touch an obstacle's closed square at all?
bool clear_line(const ObstacleMap& map, std::size_t from, std::size_t to) {
  const Grid& g = map.grid;
  const PathMission line{{g.center(g.cell_at(from)), g.center(g.cell_at(to))}, false};
  const auto cells = cells_on_path(g, line);
  return std::all_of(cells.begin(), cells.end(),
                     [&](const PathCell& c) { return map.obstacle[c.index] == 0; });
}

// Does it pass through the core of an obstacle cell, the inner two fifths of its width?
bool walled_line(const ObstacleMap& map, std::size_t from, std::size_t to) {
  const Grid& g = map.grid;
  const Vec2 a = g.center(g.cell_at(from));
  const Vec2 b = g.center(g.cell_at(to));
  for (int k = 0; k <= 600; ++k) {
    const Vec2 p = a + (k / 600.0) * (b - a);
    const Cell c = g.cell_of(p);
    const Vec2 off = (1.0 / g.cell_m) * (p - g.center(c));
    if (map.obstacle[g.index(c)] != 0 && std::fabs(off.x) < 0.2 && std::fabs(off.y) < 0.2) {
      return true;
    }
  }
  return false;
}

// Thin walls, bent and with gaps: lines out of the buffer are often barred.
ObstacleMap thin_walls(Random& random) {
  Mask m(70, 60);
  for (int k = 0; k < 9; ++k) {
    int x = 4 + static_cast<int>(random.below(62));
    int y = 4 + static_cast<int>(random.below(52));
    const int length = 5 + static_cast<int>(random.below(14));
    int dx = random.below(2) == 0 ? 1 : 0;
    int dy = 1 - dx;
    for (int n = 0; n < length; ++n) {
      if (x >= 0 && y >= 0 && x < 70 && y < 60) m.at(x, y) = 1;
      if (random.below(6) == 0) std::swap(dx, dy);
      x += dx;
      y += dy;
    }
  }
  for (int iy = 18; iy < 43; ++iy) {
    for (int ix = 24; ix < 49; ++ix) m.at(ix, iy) = 0;
  }
  return samples::map_of(m, 1.0);
}

const GoalMission middle{{36.2, 30.7}, {}};

TEST(RawFieldInTheBuffer, WhereTheLineIsClearItPointsToANearestBorderCell) {
  Random random(104);
  std::size_t clear = 0;
  for (int draw = 0; draw < 12; ++draw) {
    const ObstacleMap map = thin_walls(random);
    const Grid& g = map.grid;
    const Steps s = steps_of(map, middle, Metric::euclidean, 0.9);
    for (std::size_t i = 0; i < g.size(); ++i) {
      const std::uint32_t out = s.nearest.nearest[i];
      if (s.complete.region[i] != Region::buffer || !clear_line(map, i, out)) continue;
      ++clear;
      const Vec2 way = g.center(g.cell_at(out)) - g.center(g.cell_at(i));
      ASSERT_LT(angle_between(direction(s, i), way), 1e-6) << "cell " << i << ", draw " << draw;
      ASSERT_EQ(s.border.nearest[i], out);
      ASSERT_NEAR(s.cost[i], s.safe_start_cost[out] + norm(way), 1e-4);
    }
  }
  EXPECT_GT(clear, 3000U);
}

TEST(RawFieldInTheBuffer, ABarredCellGoesRoundAndNeverThroughTheWall) {
  Random random(105);
  std::size_t barred = 0;
  for (int draw = 0; draw < 40; ++draw) {
    const ObstacleMap map = thin_walls(random);
    const Grid& g = map.grid;
    const Steps s = steps_of(map, middle, draw % 2 == 0 ? Metric::euclidean : Metric::octile, 0.9);
    for (std::size_t i = 0; i < g.size(); ++i) {
      const std::uint32_t out = s.nearest.nearest[i];
      if (s.complete.region[i] != Region::buffer || !walled_line(map, i, out)) continue;
      ++barred;
      if (!std::isfinite(s.cost[i])) {
        ASSERT_EQ(norm(direction(s, i)), 0.0);
        ASSERT_EQ(s.border.nearest[i], no_feature);
        continue;
      }
      // The way round is longer than the barred line, and leads to a border cell.
      ASSERT_NE(s.border.nearest[i], no_feature);
      ASSERT_TRUE(std::isfinite(s.safe_start_cost[s.border.nearest[i]]));
      ASSERT_NE(s.complete.region[s.border.nearest[i]], Region::buffer);
      // Cell by cell in its direction it descends and meets no wall on the way out.
      Cell c = g.cell_at(i);
      for (int n = 0; n < 200 && s.complete.region[g.index(c)] == Region::buffer; ++n) {
        const Vec2 f = direction(s, g.index(c));
        const Cell next{c.ix + static_cast<int>(std::lround(f.x)),
                        c.iy + static_cast<int>(std::lround(f.y))};
        ASSERT_TRUE(g.contains(next));
        ASSERT_EQ(map.obstacle[g.index(next)], 0)
            << "from cell " << i << " into the wall at " << next.ix << ", " << next.iy;
        c = next;
      }
      ASSERT_NE(s.complete.region[g.index(c)], Region::buffer) << "cell " << i << " never gets out";
    }
  }
  EXPECT_GT(barred, 40U);
}

TEST(RawFieldInTheBuffer, OnlyCellsWithoutAWayOutAreLeftWithoutACommand) {
  Random random(106);
  for (int draw = 0; draw < 20; ++draw) {
    const ObstacleMap map = thin_walls(random);
    const Grid& g = map.grid;
    const Steps s = steps_of(map, middle, Metric::euclidean, 0.9);
    // Flood from reachable safe start: through the buffer only, and through everything but walls.
    for (const bool through_pockets : {false, true}) {
      std::vector<std::uint8_t> joined(g.size(), 0);
      std::vector<std::size_t> open;
      for (std::size_t i = 0; i < g.size(); ++i) {
        if (std::isfinite(s.safe_start_cost[i])) open.push_back(i);
      }
      for (const std::size_t i : open) joined[i] = 1;
      while (!open.empty()) {
        const Cell c = g.cell_at(open.back());
        open.pop_back();
        for (int k = 0; k < 9; ++k) {
          const Cell n{c.ix + k % 3 - 1, c.iy + k / 3 - 1};
          if (!g.contains(n) || joined[g.index(n)] != 0) continue;
          const Region r = s.complete.region[g.index(n)];
          if (r != Region::buffer && !(through_pockets && r == Region::free)) continue;
          joined[g.index(n)] = 1;
          open.push_back(g.index(n));
        }
      }
      for (std::size_t i = 0; i < g.size(); ++i) {
        if (s.complete.region[i] != Region::buffer) continue;
        if (through_pockets) {
          ASSERT_TRUE(!std::isfinite(s.cost[i]) || joined[i] != 0) << "cell " << i;
        } else {
          ASSERT_TRUE(std::isfinite(s.cost[i]) || joined[i] == 0) << "cell " << i;
        }
      }
    }
  }
}

TEST(RawFieldInTheBuffer, AWalledInYardHasNoCommandAndNoCellPointsIntoIt) {
  // A yard of 5 x 5 cells behind a wall of one cell; alpha r is two cells and more.
  Mask m(60, 50);
  for (int k = 20; k <= 26; ++k) {
    m.at(k, 20) = m.at(k, 26) = m.at(20, k) = m.at(26, k) = 1;
  }
  const ObstacleMap map = samples::map_of(m, 1.0);
  const GoalMission away{{48.0, 40.0}, {}};
  for (const Metric metric : {Metric::euclidean, Metric::octile}) {
    const Steps s = steps_of(map, away, metric, 0.55);
    EXPECT_EQ(s.complete.region[map.grid.index({23, 23})], Region::free) << "no pocket at all";
    for (int iy = 0; iy < 50; ++iy) {
      for (int ix = 0; ix < 60; ++ix) {
        const std::size_t i = map.grid.index({ix, iy});
        const bool yard = ix > 20 && ix < 26 && iy > 20 && iy < 26;
        if (map.obstacle[i] != 0) continue;
        EXPECT_EQ(std::isfinite(s.cost[i]), !yard) << ix << ", " << iy;
        EXPECT_EQ(norm(direction(s, i)) > 0.0, !yard) << ix << ", " << iy;
      }
    }
    // Just outside the wall the nearest free cell to the north is much nearer than the yard.
    EXPECT_LT(direction(s, map.grid.index({23, 19})).y, -0.99);
    EXPECT_GT(direction(s, map.grid.index({27, 23})).x, 0.99);
  }
}

}  // namespace
}  // namespace fairway
