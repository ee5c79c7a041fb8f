#include "fairway/field/complete_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>
#include <utility>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/field/testing/sample_maps.hpp"

namespace fairway {
namespace {

using Reason = MissionRefusal::Reason;
using samples::Mask;

constexpr Vehicle vehicle{10.0, 5.0};  // r = 5 m

std::variant<CompleteMap, MissionRefusal> placed(const ObstacleMap& map, const Mission& mission,
                                                 const FieldOptions& options) {
  return complete_map(map, vehicle, mission, options);
}

std::vector<Vec2> obstacle_centers(const ObstacleMap& map) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    if (map.obstacle[i] != 0) out.push_back(map.grid.center(map.grid.cell_at(i)));
  }
  return out;
}

double clearance(const std::vector<Vec2>& obstacles, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2 o : obstacles) least = std::min(least, norm(p - o));
  return least;
}

// Eq. 3 by all pairs; a distance of exactly alpha * r is buffer.
std::vector<Region> by_equation_3(const ObstacleMap& map, double alpha) {
  const std::vector<Vec2> obstacles = obstacle_centers(map);
  std::vector<Region> out(map.grid.size(), Region::free);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double d = clearance(obstacles, map.grid.center(map.grid.cell_at(i)));
    if (d <= alpha * vehicle.turn_radius_m * (1.0 + 1e-9)) out[i] = Region::buffer;
    if (map.obstacle[i] != 0) out[i] = Region::obstacle;
  }
  return out;
}

// Algorithm 1, line by line: whole sweeps, a new map from the old one.
std::vector<Region> by_algorithm_1(const ObstacleMap& map, double alpha) {
  const Grid& g = map.grid;
  std::vector<double> m(map.obstacle.begin(), map.obstacle.end());
  const auto buffer =
      static_cast<int>(std::ceil(alpha * vehicle.turn_radius_m / g.cell_m - 1e-9));  // line 2
  for (int cost = 1; cost < buffer + 1; ++cost) {                                    // lines 3, 4
    const std::vector<double> old = m;
    for (std::size_t i = 0; i < m.size(); ++i) {  // line 6
      if (old[i] != 0.0) continue;
      const Cell c = g.cell_at(i);
      const auto least = [&](const std::array<Cell, 4>& around) {
        double out = std::numeric_limits<double>::infinity();
        for (const Cell n : around) {
          if (g.contains(n) && old[g.index(n)] >= 1.0) out = std::min(out, old[g.index(n)]);
        }
        return out;
      };
      const double axial = least(
          {Cell{c.ix + 1, c.iy}, Cell{c.ix, c.iy + 1}, Cell{c.ix - 1, c.iy}, Cell{c.ix, c.iy - 1}});
      const double diagonal = least({Cell{c.ix + 1, c.iy - 1}, Cell{c.ix + 1, c.iy + 1},
                                     Cell{c.ix - 1, c.iy + 1}, Cell{c.ix - 1, c.iy - 1}});
      if (std::isfinite(axial)) {  // lines 9 to 12
        m[i] = axial + 1.0;
      } else if (std::isfinite(diagonal)) {
        m[i] = diagonal + 1.41;
      }
    }
  }
  std::vector<Region> out(m.size());
  for (std::size_t i = 0; i < m.size(); ++i) {  // lines 16 to 18
    out[i] = m[i] > 1.0 ? Region::buffer : m[i] == 1.0 ? Region::obstacle : Region::free;
  }
  return out;
}

// A map with a free corner for a goal, so that the rest can be checked.
struct Case {
  ObstacleMap map;
  GoalMission goal;
};
Case random_case(Random& random, double cell_m) {
  const int nx = 40 + static_cast<int>(random.below(30));
  const int ny = 40 + static_cast<int>(random.below(30));
  Mask m = samples::blobs(random, nx, ny, static_cast<int>(random.below(9)), 5.0);
  return {samples::map_of(m, cell_m, -13.0, 4.5),
          {{-13.0 + random.unit() * nx * cell_m, 4.5 + random.unit() * ny * cell_m}, {}}};
}

TEST(CompleteMapOfAMission, IsEquation3AndTheGoalDisc) {
  Random random(71);
  int accepted = 0;
  for (int draw = 0; draw < 120; ++draw) {
    const double cell_m = draw % 2 == 0 ? 1.0 : 1.7;
    const Case c = random_case(random, cell_m);
    FieldOptions options;
    options.alpha = draw % 3 == 0 ? 1.0 : random.uniform(0.1, 1.5);
    options.beta = random.uniform(0.5, 2.0);
    options.metric = draw % 2 == 0 ? Metric::euclidean : Metric::octile;
    const auto found = placed(c.map, c.goal, options);
    const auto* complete = std::get_if<CompleteMap>(&found);
    if (complete == nullptr) continue;
    ++accepted;
    std::vector<Region> expected = by_equation_3(c.map, options.alpha);
    for (const std::uint32_t i : cells_inside_disc(c.map.grid, c.goal.goal_m, 5.0 * options.beta)) {
      ASSERT_EQ(expected[i], Region::free) << "Assumption 1";
      expected[i] = Region::goal;
    }
    ASSERT_EQ(complete->region, expected) << "draw " << draw;
    const std::vector<Vec2> obstacles = obstacle_centers(c.map);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double d = clearance(obstacles, c.map.grid.center(c.map.grid.cell_at(i))) / cell_m;
      if (obstacles.empty()) break;
      ASSERT_NEAR(std::sqrt(complete->clearance_cells2[i]), d, 1e-9 * (1.0 + d));
    }
    std::vector<std::uint32_t> goal_cells;
    for (std::uint32_t i = 0; i < expected.size(); ++i) {
      if (expected[i] == Region::goal) goal_cells.push_back(i);
    }
    ASSERT_EQ(complete->goal_cells, goal_cells);
    ASSERT_TRUE(complete->path_cells.empty());
  }
  EXPECT_GT(accepted, 25);
}

TEST(CompleteMapOfAMission, WithThePapersMetricIsAlgorithm1AndNeverNarrowerThanEquation3) {
  Random random(72);
  int accepted = 0;
  for (int draw = 0; draw < 120; ++draw) {
    const Case c = random_case(random, draw % 2 == 0 ? 1.0 : 1.7);
    FieldOptions options;
    options.metric = Metric::paper;
    options.alpha = draw % 3 == 0 ? 1.0 : random.uniform(0.1, 1.5);
    options.beta = random.uniform(0.5, 1.5);
    const auto found = placed(c.map, c.goal, options);
    const auto* complete = std::get_if<CompleteMap>(&found);
    if (complete == nullptr) continue;
    ++accepted;
    std::vector<Region> expected = by_algorithm_1(c.map, options.alpha);
    const std::vector<Region> round = by_equation_3(c.map, options.alpha);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_TRUE(round[i] != Region::buffer || expected[i] == Region::buffer) << "cell " << i;
    }
    for (const std::uint32_t i : complete->goal_cells) expected[i] = Region::goal;
    ASSERT_EQ(complete->region, expected) << "draw " << draw;
  }
  EXPECT_GT(accepted, 25);
}

TEST(CompleteMapOfAMission, HasNoBufferWithoutObstaclesHoweverWideItWouldBe) {
  const ObstacleMap map = samples::map_of(Mask(50, 40), 1.0);
  for (const Metric metric : {Metric::euclidean, Metric::octile, Metric::paper}) {
    for (const double alpha : {1e-12, 2.0, 1e5, 1e12}) {
      FieldOptions options;
      options.alpha = alpha;
      options.metric = metric;
      const auto found = placed(map, GoalMission{{25.0, 20.0}, {}}, options);
      ASSERT_TRUE(std::holds_alternative<CompleteMap>(found)) << "alpha " << alpha;
      const auto& region = std::get<CompleteMap>(found).region;
      EXPECT_EQ(std::count(region.begin(), region.end(), Region::buffer), 0) << "alpha " << alpha;
    }
  }
}

TEST(CompleteMapOfAMission, ANarrowBufferIsNarrow) {
  Mask m(50, 40);
  m.at(3, 3) = 1;
  const ObstacleMap map = samples::map_of(m, 1.0);
  for (const auto& [metric, width] :
       std::vector<std::pair<Metric, int>>{{Metric::euclidean, 0}, {Metric::paper, 8}}) {
    FieldOptions options;
    options.alpha = 1e-12;  // Algorithm 1 rounds up to one sweep
    options.metric = metric;
    const auto found = placed(map, GoalMission{{30.0, 20.0}, {}}, options);
    const auto& region = std::get<CompleteMap>(found).region;
    EXPECT_EQ(std::count(region.begin(), region.end(), Region::buffer), width);
  }
}

// --- Assumption 1 --------------------------------------------------------------------------------

const MissionRefusal* refusal_in(const std::variant<CompleteMap, MissionRefusal>& found) {
  return std::get_if<MissionRefusal>(&found);
}

TEST(Assumption1, AGoalDiscInTheBufferIsRefusedWithTheClearanceItLacks) {
  Random random(73);
  int refused = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const Case c = random_case(random, 1.3);
    FieldOptions options;
    options.alpha = random.uniform(0.5, 1.5);
    options.beta = random.uniform(0.5, 1.5);
    const auto found = placed(c.map, c.goal, options);
    const MissionRefusal* refusal = refusal_in(found);
    const std::vector<Vec2> obstacles = obstacle_centers(c.map);
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : cells_inside_disc(c.map.grid, c.goal.goal_m, 5.0 * options.beta)) {
      least = std::min(least, clearance(obstacles, c.map.grid.center(c.map.grid.cell_at(i))));
    }
    const bool fits = least > options.alpha * 5.0 * (1.0 + 1e-9);
    ASSERT_EQ(refusal == nullptr, fits) << "draw " << draw;
    if (fits || refusal->reason != Reason::in_buffer) continue;
    ++refused;
    EXPECT_NEAR(refusal->lacks_m, options.alpha * 5.0 - least, 1e-9) << refusal->message;
    std::smatch number;
    ASSERT_TRUE(std::regex_search(refusal->message, number, std::regex("it lacks ([0-9.e-]+) m")));
    EXPECT_NEAR(std::stod(number[1]), refusal->lacks_m, 0.0051);  // to the centimetre
  }
  EXPECT_GT(refused, 25);
}

int square_distance(const ObstacleMap& map, std::size_t index) {
  const Cell c = map.grid.cell_at(index);
  int least = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    const Cell o = map.grid.cell_at(i);
    if (map.obstacle[i] != 0) {
      least = std::min(least, std::max(std::abs(o.ix - c.ix), std::abs(o.iy - c.iy)));
    }
  }
  return least;
}

TEST(Assumption1, WithThePapersMetricTheShortageIsCountedInItsSquareBuffer) {
  Random random(75);
  int refused = 0;
  int round_enough = 0;  // in a corner of the square, where the straight distance would suffice
  for (int draw = 0; draw < 300; ++draw) {
    const Case c = random_case(random, 1.3);
    FieldOptions options;
    options.metric = Metric::paper;
    options.alpha = random.uniform(0.5, 2.5);
    options.beta = random.uniform(0.5, 1.5);
    const auto found = placed(c.map, c.goal, options);
    const MissionRefusal* refusal = refusal_in(found);
    if (refusal == nullptr || refusal->reason != Reason::in_buffer) continue;
    ++refused;
    int least = std::numeric_limits<int>::max();
    double straight = std::numeric_limits<double>::infinity();
    const std::vector<Vec2> obstacles = obstacle_centers(c.map);
    for (const std::uint32_t i : cells_inside_disc(c.map.grid, c.goal.goal_m, 5.0 * options.beta)) {
      least = std::min(least, square_distance(c.map, i));
      straight = std::min(straight, clearance(obstacles, c.map.grid.center(c.map.grid.cell_at(i))));
    }
    if (straight > options.alpha * 5.0) ++round_enough;
    // The buffer is ceil(alpha r / cell) cells wide; the first cell beyond it is free.
    const double expected = (std::ceil(options.alpha * 5.0 / 1.3) + 1 - least) * 1.3;
    ASSERT_GT(expected, 0.0);
    EXPECT_NEAR(refusal->lacks_m, expected, 1e-9) << refusal->message;
    std::smatch number;
    ASSERT_TRUE(std::regex_search(refusal->message, number, std::regex("it lacks ([0-9.e-]+) m")));
    EXPECT_NEAR(std::stod(number[1]), refusal->lacks_m, 0.0051) << refusal->message;
  }
  EXPECT_GT(refused, 50);
  EXPECT_GT(round_enough, 5);
}

TEST(Assumption1, WithThePapersMetricTheAlphaProposedForAPathIsTheLargestThatFits) {
  Random random(76);
  int tried = 0;
  int hopeless = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const Case c = random_case(random, 1.3);
    const Vec2 size{c.map.grid.width_m(), c.map.grid.height_m()};
    const auto anywhere = [&] {
      return Vec2{c.map.grid.x0_m + random.unit() * size.x,
                  c.map.grid.y0_m + random.unit() * size.y};
    };
    const PathMission path{{anywhere(), anywhere()}};
    FieldOptions options;
    options.metric = Metric::paper;
    options.alpha = random.uniform(1.0, 3.0);
    const auto found = placed(c.map, path, options);
    const MissionRefusal* refusal = refusal_in(found);
    if (refusal == nullptr || refusal->reason != Reason::in_buffer) continue;
    std::smatch number;
    if (!std::regex_search(refusal->message, number, std::regex("alpha up to ([0-9.]+) would"))) {
      EXPECT_NE(refusal->message.find("no alpha fits"), std::string::npos);
      options.alpha = 1e-6;
      EXPECT_TRUE(std::holds_alternative<MissionRefusal>(placed(c.map, path, options)));
      ++hopeless;
      continue;
    }
    ++tried;
    options.alpha = std::stod(number[1]);
    EXPECT_TRUE(std::holds_alternative<CompleteMap>(placed(c.map, path, options)))
        << refusal->message;
    options.alpha += 2e-4;
    EXPECT_TRUE(std::holds_alternative<MissionRefusal>(placed(c.map, path, options)))
        << refusal->message;
  }
  EXPECT_GT(tried, 20);
  EXPECT_GT(hopeless, 2);
}

// The nearest cell centre around which the disc's cells are all free, by trying every one.
double nearest_fit(const ObstacleMap& map, Vec2 goal, const FieldOptions& options) {
  const std::vector<Region> region = by_equation_3(map, options.alpha);
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < region.size(); ++i) {
    const Vec2 p = map.grid.center(map.grid.cell_at(i));
    const auto cells = cells_inside_disc(map.grid, p, 5.0 * options.beta + 0.009);
    if (std::all_of(cells.begin(), cells.end(),
                    [&](std::uint32_t k) { return region[k] == Region::free; })) {
      best = std::min(best, norm(p - goal));
    }
  }
  return best;
}

TEST(Assumption1, TheGoalProposedInsteadFitsAndIsTheNearest) {
  Random random(74);
  int tried = 0;
  int hopeless = 0;
  for (int draw = 0; draw < 150; ++draw) {
    Case c = random_case(random, draw % 2 == 0 ? 1.3 : 0.05 * 25);
    if (draw % 3 == 0) {  // as in projected coordinates
      c.map.grid.x0_m += 500'000.0;
      c.map.grid.y0_m += 4'200'000.0;
      c.goal.goal_m = c.goal.goal_m + Vec2{500'000.0, 4'200'000.0};
    }
    FieldOptions options;
    options.alpha = random.uniform(0.5, draw % 5 == 0 ? 6.0 : 1.5);
    options.beta = random.uniform(0.8, 1.5);
    const auto found = placed(c.map, c.goal, options);
    const MissionRefusal* refusal = refusal_in(found);
    if (refusal == nullptr) continue;
    std::smatch place;
    const std::regex pattern(R"(the nearest goal that fits is \[([^,]*), ([^\]]*)\])");
    const double nearest = nearest_fit(c.map, c.goal.goal_m, options);
    if (!std::regex_search(refusal->message, place, pattern)) {
      EXPECT_NE(refusal->message.find("no such goal fits"), std::string::npos) << refusal->message;
      EXPECT_TRUE(std::isinf(nearest)) << refusal->message;
      ++hopeless;
      continue;
    }
    ++tried;
    const GoalMission again{{std::stod(place[1]), std::stod(place[2])}, {}};
    EXPECT_TRUE(std::holds_alternative<CompleteMap>(placed(c.map, again, options)))
        << refusal->message;
    // As printed: to the centimetre.
    EXPECT_LE(norm(again.goal_m - c.goal.goal_m), nearest + 0.0072) << refusal->message;
  }
  EXPECT_GT(tried, 40);
  EXPECT_GT(hopeless, 0);
}

TEST(Assumption1, EveryReasonIsNamed) {
  Mask m(60, 60);
  for (int i = 0; i < 60; ++i) m.at(30, i) = 1;
  const ObstacleMap map = samples::map_of(m, 1.0);
  FieldOptions options;
  options.alpha = 1.0;
  options.beta = 1.0;
  const auto reason_of = [&](const Mission& mission) {
    const auto found = placed(map, mission, options);
    const MissionRefusal* refusal = refusal_in(found);
    EXPECT_NE(refusal, nullptr);
    if (refusal == nullptr) return Reason::unreachable;
    EXPECT_FALSE(refusal->message.empty());
    EXPECT_EQ(refusal->lacks_m > 0.0, refusal->reason == Reason::in_buffer) << refusal->message;
    return refusal->reason;
  };
  EXPECT_EQ(reason_of(GoalMission{{-0.1, 20.0}, {}}), Reason::outside_map);
  EXPECT_EQ(reason_of(GoalMission{{20.0, 60.1}, {}}), Reason::outside_map);
  EXPECT_EQ(reason_of(GoalMission{{30.5, 20.0}, {}}), Reason::in_obstacle);
  EXPECT_EQ(reason_of(GoalMission{{23.0, 20.0}, {}}), Reason::in_buffer);
  EXPECT_EQ(reason_of(PathMission{{{5.0, 5.0}, {5.0, 61.0}}}), Reason::outside_map);
  EXPECT_EQ(reason_of(PathMission{{{5.0, 5.0}, {50.0, 50.0}}}), Reason::in_obstacle);
  EXPECT_EQ(reason_of(PathMission{{{5.0, 5.0}, {27.0, 20.0}}}), Reason::in_buffer);
  options.beta = 0.05;
  EXPECT_EQ(reason_of(GoalMission{{10.0, 10.0}, {}}), Reason::goal_too_small);
}

TEST(Assumption1, AMapOfOnlyObstaclesHasNoRoomForAnyMission) {
  for (const auto& [nx, ny] : std::vector<std::array<int, 2>>{{1, 1}, {1, 9}, {9, 1}, {20, 20}}) {
    const ObstacleMap map = samples::map_of(Mask(nx, ny, 1), 1.0);
    for (const Metric metric : {Metric::euclidean, Metric::octile, Metric::paper}) {
      FieldOptions options;
      options.metric = metric;
      const auto goal = placed(map, GoalMission{{0.5, 0.5}, {}}, options);
      ASSERT_NE(refusal_in(goal), nullptr);
      EXPECT_EQ(refusal_in(goal)->reason, Reason::in_obstacle);
      const auto path = placed(map, PathMission{{{0.1, 0.1}, {0.9, 0.9}}}, options);
      ASSERT_NE(refusal_in(path), nullptr);
      EXPECT_EQ(refusal_in(path)->reason, Reason::in_obstacle);
    }
  }
}

TEST(Assumption1, AGoalAtTheCornerOfFourCellsOrOfTheMapIsPlaced) {
  const ObstacleMap map = samples::map_of(Mask(40, 40), 1.0);
  FieldOptions options;
  for (const Vec2 goal : {Vec2{20.0, 20.0}, Vec2{0.0, 0.0}, Vec2{40.0, 40.0}, Vec2{40.0, 0.0}}) {
    const auto found = placed(map, GoalMission{goal, {}}, options);
    ASSERT_TRUE(std::holds_alternative<CompleteMap>(found)) << goal.x << ", " << goal.y;
    EXPECT_FALSE(std::get<CompleteMap>(found).goal_cells.empty());
  }
}

TEST(Assumption1, APathWithoutLengthIsNotAMission) {
  const ObstacleMap map = samples::map_of(Mask(20, 20), 1.0);
  const PathMission path{{{5.0, 5.0}, {5.0, 5.0}}, true};
  EXPECT_THROW(static_cast<void>(placed(map, path, {})), PreconditionViolation);
}

TEST(Assumption1, APathKeepsItsCellsAndTheirTangents) {
  Mask m(60, 60);
  m.at(50, 50) = 1;
  const ObstacleMap map = samples::map_of(m, 1.0);
  const PathMission path{{{5.0, 5.0}, {30.0, 12.0}, {8.0, 40.0}}, true};
  const auto found = placed(map, path, {});
  const auto& complete = std::get<CompleteMap>(found);
  ASSERT_EQ(complete.path_cells.size(), complete.goal_cells.size());
  const auto listed = cells_on_path(map.grid, path);
  ASSERT_EQ(listed.size(), complete.path_cells.size());
  for (std::size_t k = 0; k < listed.size(); ++k) {
    EXPECT_EQ(complete.goal_cells[k], listed[k].index);
    EXPECT_EQ(complete.path_cells[k].tangent, listed[k].tangent);
    EXPECT_EQ(complete.region[listed[k].index], Region::goal);
  }
}

}  // namespace
}  // namespace fairway
