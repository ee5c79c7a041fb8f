#include "fairway/field/cost_to_go.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "fairway/field/octile.hpp"
#include "fairway/field/testing/sample_maps.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway {
namespace {

using samples::Mask;

constexpr Vehicle vehicle{10.0, 4.0};

CompleteMap complete_of(const ObstacleMap& map, const Mission& mission, Metric metric) {
  FieldOptions options;
  options.alpha = 1.0;
  options.beta = 1.0;
  options.metric = metric;
  auto found = complete_map(map, vehicle, mission, options);
  const auto* refusal = std::get_if<MissionRefusal>(&found);
  if (refusal != nullptr) throw std::runtime_error(refusal->message);
  return std::get<CompleteMap>(std::move(found));
}

bool safe(Region r) { return r == Region::free || r == Region::goal; }

// Is a cell connected to a goal cell through safe-start cells, by sides and corners?
std::vector<std::uint8_t> joined_to_goal(const Grid& g, const CompleteMap& complete) {
  std::vector<std::uint8_t> out(g.size(), 0);
  std::vector<std::uint32_t> open = complete.goal_cells;
  for (const std::uint32_t i : open) out[i] = 1;
  while (!open.empty()) {
    const Cell c = g.cell_at(open.back());
    open.pop_back();
    for (int k = 0; k < 9; ++k) {
      const Cell n{c.ix + k % 3 - 1, c.iy + k / 3 - 1};
      if (!g.contains(n) || out[g.index(n)] != 0 || !safe(complete.region[g.index(n)])) continue;
      out[g.index(n)] = 1;
      open.push_back(static_cast<std::uint32_t>(g.index(n)));
    }
  }
  return out;
}

ObstacleMap blob_map(Random& random) {
  Mask m = samples::blobs(random, 70, 60, 9, 4.0);
  for (int iy = 20; iy < 42; ++iy) {  // room for the missions
    for (int ix = 20; ix < 50; ++ix) m.at(ix, iy) = 0;
  }
  return samples::map_of(m, 1.0, -7.0, 3.0);
}

const GoalMission goal{{28.3, 34.2}, {}};
const PathMission path{{{18.2, 28.1}, {37.9, 29.5}, {37.0, 38.0}}, false};

TEST(CostToGo, IsFiniteExactlyWhereSafeStartIsConnectedToTheGoal) {
  Random random(81);
  std::size_t pockets = 0;
  for (int draw = 0; draw < 10; ++draw) {
    const ObstacleMap map = blob_map(random);
    for (const Mission& mission : {Mission{goal}, Mission{path}}) {
      for (const Metric metric : {Metric::euclidean, Metric::octile, Metric::paper}) {
        const CompleteMap complete = complete_of(map, mission, metric);
        const std::vector<float> cost = cost_to_go(map.grid, complete, mission, metric);
        const std::vector<std::uint8_t> joined = joined_to_goal(map.grid, complete);
        for (std::size_t i = 0; i < cost.size(); ++i) {
          ASSERT_EQ(std::isfinite(cost[i]), joined[i] != 0) << "cell " << i << ", draw " << draw;
          ASSERT_GE(cost[i], 0.0F);
          pockets += complete.region[i] == Region::free && joined[i] == 0 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(pockets, 0U) << "no map had a walled-off pocket";
}

TEST(CostToGo, EuclideanStartsFromTheExactDistancesOfTheMissionsCells) {
  Random random(82);
  const ObstacleMap map = blob_map(random);
  const Grid& g = map.grid;
  const CompleteMap to_goal = complete_of(map, goal, Metric::euclidean);
  const std::vector<float> cost = cost_to_go(g, to_goal, goal, Metric::euclidean);
  for (const std::uint32_t i : to_goal.goal_cells) {
    EXPECT_NEAR(cost[i], norm(g.center(g.cell_at(i)) - goal.goal_m) / g.cell_m, 1e-5);
  }
  const CompleteMap to_path = complete_of(map, path, Metric::euclidean);
  const std::vector<float> way = cost_to_go(g, to_path, path, Metric::euclidean);
  for (const PathCell& c : to_path.path_cells) {
    EXPECT_LE(way[c.index], c.distance_m / g.cell_m + 1e-5);
  }
}

TEST(CostToGo, InTheOpenEuclideanIsWithinAQuarterOfACellOfTheDistanceToTheGoalOrThePath) {
  const ObstacleMap map = samples::map_of(Mask(90, 80), 0.5, -7.0, 3.0);
  const Grid& g = map.grid;
  const GoalMission point{{14.3, 21.9}, {}};
  const std::vector<float> cost =
      cost_to_go(g, complete_of(map, point, Metric::euclidean), point, Metric::euclidean);
  double worst = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const Vec2 p = g.center(g.cell_at(i));
    worst = std::max(worst, std::fabs(cost[i] - norm(p - point.goal_m) / g.cell_m));
  }
  EXPECT_LT(worst, 0.2);  // measured: 0.190 cells, at the far corner
  // Measured: 0.045, 0.046, 0.053, 0.117, 0.214 cells.
  for (const double rise_m : {0.0, 0.3, 2.0, 9.0, 21.0}) {
    const PathMission line{{{-6.6, 12.1}, {37.6, 12.1 + rise_m}}, false};
    const std::vector<float> way =
        cost_to_go(g, complete_of(map, line, Metric::euclidean), line, Metric::euclidean);
    worst = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      const double exact = nearest_on_path(g.center(g.cell_at(i)), line).distance_m / g.cell_m;
      worst = std::max(worst, std::fabs(way[i] - exact));
    }
    EXPECT_LT(worst, 0.22) << "the line rises by " << rise_m << " m";
  }
}

TEST(CostToGo, OctileAndPaperCountStepsFromTheGoalsCellOrFromEveryPathCell) {
  Random random(83);
  const ObstacleMap map = blob_map(random);
  const Grid& g = map.grid;
  const auto start = static_cast<std::uint32_t>(g.index(g.cell_of(goal.goal_m)));
  for (const Mission& mission : {Mission{goal}, Mission{path}}) {
    for (const Metric metric : {Metric::octile, Metric::paper}) {
      const CompleteMap complete = complete_of(map, mission, metric);
      std::vector<std::uint8_t> inside(g.size());
      for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = safe(complete.region[i]) ? 1 : 0;
      const std::vector<std::uint32_t> sources = std::holds_alternative<GoalMission>(mission)
                                                     ? std::vector<std::uint32_t>(1, start)
                                                     : complete.goal_cells;
      const std::vector<float> expected =
          metric == Metric::octile ? octile_distance(inside, g.nx, g.ny, sources)
                                   : paper_wavefront(inside, g.nx, g.ny, sources, 2.0F, 0);
      const std::vector<float> cost = cost_to_go(g, complete, mission, metric);
      const float less = metric == Metric::paper ? 2.0F : 0.0F;
      for (std::size_t i = 0; i < cost.size(); ++i) {
        ASSERT_EQ(cost[i], expected[i] - less) << "cell " << i;
      }
      for (const std::uint32_t s : sources) EXPECT_EQ(cost[s], 0.0F);
    }
  }
}

TEST(CostToGo, AGoalOnTheMapsUpperCornerCountsFromTheLastCell) {
  const ObstacleMap map = samples::map_of(Mask(30, 20), 1.0);
  const GoalMission corner{{30.0, 20.0}, {}};
  for (const Metric metric : {Metric::octile, Metric::paper}) {
    const std::vector<float> cost =
        cost_to_go(map.grid, complete_of(map, corner, metric), corner, metric);
    EXPECT_EQ(cost.back(), 0.0F);
    EXPECT_TRUE(std::isfinite(cost.front()));
  }
}

}  // namespace
}  // namespace fairway
