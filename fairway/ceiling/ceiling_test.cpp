// Both bounds of a ceiling, against flights: what flew to the mission is never called lost, and
// what is called inside can be flown there.
#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/ceiling/ceiling_level.hpp"
#include "fairway/ceiling/find_ceiling.hpp"

namespace fairway {
namespace {

const auto never = [] { return false; };

/// '#' obstacle, 'G' goal, '.' free; the first row is the highest.
CeilingCells cells_of(const std::vector<std::string>& rows, double side) {
  CeilingCells cells{static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), side, {}, {}};
  for (std::size_t y = rows.size(); y-- > 0;) {
    for (const char c : rows[y]) {
      cells.obstacle.push_back(c == '#' ? 1 : 0);
      cells.goal.push_back(c == 'G' ? 1 : 0);
    }
  }
  return cells;
}

std::vector<Region> region_of(const CeilingCells& cells) {
  std::vector<Region> region;
  for (std::size_t i = 0; i < cells.obstacle.size(); ++i) {
    region.push_back(cells.obstacle[i] != 0 ? Region::obstacle
                     : cells.goal[i] != 0   ? Region::goal
                                            : Region::buffer);
  }
  return region;
}

Ceiling ceiling_of(const CeilingCells& cells, int levels) {
  const Grid grid{cells.nx, cells.ny, 0.0, 0.0, cells.side};
  CeilingOptions options;
  options.levels_max = levels;
  options.gap_max = 1e-6;
  return find_ceiling(grid, region_of(cells), Vehicle{1.0, 1.0}, options);
}

CeilingLevel level_of(const CeilingCells& cells, int level, const CeilingLevel* coarse = nullptr) {
  auto found = ceiling_level(cells, level, coarse, never);
  EXPECT_TRUE(found.has_value());
  return std::move(*found);
}

CeilingCells random_cells(Random& random, int nx, int ny, double side) {
  CeilingCells cells{nx, ny, side, {}, {}};
  const auto count = static_cast<std::size_t>(nx * ny);
  cells.obstacle.assign(count, 0);
  cells.goal.assign(count, 0);
  for (std::size_t i = 0; i < count / 16; ++i) {
    cells.obstacle[static_cast<std::size_t>(random.unit() * static_cast<double>(count))] = 1;
  }
  const int gx = 2 + static_cast<int>(random.unit() * (nx - 5));
  const int gy = 2 + static_cast<int>(random.unit() * (ny - 5));
  for (int y = gy; y < gy + 2; ++y) {
    for (int x = gx; x < gx + 2; ++x) {
      const auto cell = static_cast<std::size_t>(y * nx + x);
      cells.goal[cell] = 1;
      cells.obstacle[cell] = 0;
    }
  }
  return cells;
}

enum class Place { free, obstacle, goal };

/// Everything in turn radii. `margin` grows obstacles (and not the goal).
Place place_at(const CeilingCells& cells, Vec2 p) {
  const int ix = static_cast<int>(std::floor(p.x / cells.side));
  const int iy = static_cast<int>(std::floor(p.y / cells.side));
  if (ix < 0 || iy < 0 || ix >= cells.nx || iy >= cells.ny) return Place::obstacle;
  const auto cell = static_cast<std::size_t>(iy * cells.nx + ix);
  if (cells.goal[cell] != 0) return Place::goal;
  return cells.obstacle[cell] != 0 ? Place::obstacle : Place::free;
}

struct Pose {
  Vec2 place;
  double heading = 0.0;
};

/// Exact flight over `length` (backwards if negative) with curvature `turn`.
Pose flown(const Pose& from, double turn, double length) {
  const double h = from.heading;
  if (turn == 0.0) return {from.place + length * Vec2{std::cos(h), std::sin(h)}, h};
  const double end = h + turn * length;
  return {
      from.place + (1.0 / turn) * Vec2{std::sin(end) - std::sin(h), std::cos(h) - std::cos(end)},
      end};
}

bool claimed(const BallLattice& l, const std::vector<Radius>& claims, const Pose& at) {
  const double turned = at.heading - two_pi * std::floor(at.heading / two_pi);
  const int k = std::min(l.headings - 1, static_cast<int>(turned / l.bin_rad));
  const int cx = static_cast<int>(std::floor(at.place.x / l.spacing));
  const int cy = static_cast<int>(std::floor(at.place.y / l.spacing));
  for (int y = cy - 3; y <= cy + 3; ++y) {
    for (int x = cx - 3; x <= cx + 3; ++x) {
      const Vec2 node{(x + 0.5) * l.spacing, (y + 0.5) * l.spacing};
      const double radius = static_cast<double>(claims[l.at(k, y, x)]) / units_per_turn_radius;
      if (radius > 0.0 && norm(at.place - node) <= radius) return true;
    }
  }
  return false;
}

/// Flies backwards from the goal among the obstacles, as near to them as chance has it: whatever
/// state it passes comes to the goal. Returns how many states were looked at.
int fly_out_of_goal(const CeilingCells& cells, const CeilingLevel& level, Random& random) {
  std::size_t cell = 0;
  do {
    cell = static_cast<std::size_t>(random.unit() * static_cast<double>(cells.goal.size()));
  } while (cells.goal[cell] == 0);
  const Vec2 corner{static_cast<double>(cell % static_cast<std::size_t>(cells.nx)),
                    static_cast<double>(cell / static_cast<std::size_t>(cells.nx))};
  Pose at{cells.side * (corner + Vec2{random.unit(), random.unit()}), two_pi * random.unit()};
  int seen = 0;
  constexpr double piece = 0.01;
  for (int leg = 0; leg < 40; ++leg) {
    const double turn = std::clamp(std::floor(4.0 * random.unit()) - 1.0, -1.0, 1.0) *
                        (random.unit() < 0.8 ? 1.0 : random.unit());
    const double length = 2.5 * random.unit();
    for (double gone = 0.0; gone < length; gone += piece) {
      const Pose before = flown(at, turn, -piece);
      // A corner may be cut by less than a piece's arc is high: the fine step makes that 2e-5.
      if (place_at(cells, before.place) == Place::obstacle) break;
      at = before;
      if (place_at(cells, at.place) == Place::goal) continue;
      ++seen;
      EXPECT_FALSE(claimed(level.lattice, level.lost, at))
          << at.place.x << " " << at.place.y << " " << at.heading;
    }
  }
  return seen;
}

/// Flies the lattice's steps exactly, from claimed state to claimed state, the nearest to the goal
/// first, until one enters it.
bool finds_goal(const CeilingCells& cells, const CeilingLevel& level, const Pose& from) {
  const BallLattice& l = level.lattice;
  const auto goal = std::find(cells.goal.begin(), cells.goal.end(), 1) - cells.goal.begin();
  const Vec2 middle = cells.side * Vec2{static_cast<double>(goal % cells.nx + 1),
                                        static_cast<double>(goal / cells.nx + 1)};
  const auto farther = [&](const Pose& a, const Pose& b) {
    return norm(a.place - middle) > norm(b.place - middle);
  };
  std::priority_queue<Pose, std::vector<Pose>, decltype(farther)> waiting(farther);
  waiting.push(from);
  std::set<std::tuple<int, int, int>> seen;
  while (!waiting.empty() && seen.size() < 200000) {
    const Pose at = waiting.top();
    waiting.pop();
    for (int d = -l.turn_bins; d <= l.turn_bins; ++d) {
      const double turn = static_cast<double>(d) / l.turn_bins;
      constexpr int pieces = 40;
      bool free = true;
      for (int i = 1; i <= pieces && free; ++i) {
        const Place place = place_at(cells, flown(at, turn, l.step * i / pieces).place);
        if (place == Place::goal) return true;
        free = place == Place::free;
      }
      const Pose end = flown(at, turn, l.step);
      if (!free || !claimed(l, level.inside, end)) continue;
      const auto key = [](double v, double unit) { return static_cast<int>(std::floor(v / unit)); };
      const double heading = end.heading - two_pi * std::floor(end.heading / two_pi);
      if (seen.emplace(key(end.place.x, 0.3 * l.spacing), key(end.place.y, 0.3 * l.spacing),
                       key(heading, 0.5 * l.bin_rad))
              .second) {
        waiting.push(end);
      }
    }
  }
  return false;
}

const std::vector<std::string> room{"################", "#..............#", "#..............#",
                                    "#..............#", "#..............#", "#..............#",
                                    "#......GG......#", "#......GG......#", "#..............#",
                                    "#..............#", "#..............#", "################"};

}  // namespace

TEST(Ceiling, NoStateThatFliesToTheGoalIsCalledLost) {
  Random random(20261130);
  int seen = 0;
  for (int map = 0; map < 6; ++map) {
    const CeilingCells cells = random_cells(random, 14, 12, 0.3 + 0.2 * map);
    const CeilingLevel coarse = level_of(cells, 0);
    const CeilingLevel fine = level_of(cells, 1, &coarse);
    for (int flight = 0; flight < 100; ++flight) {
      seen += fly_out_of_goal(cells, coarse, random);
      seen += fly_out_of_goal(cells, fine, random);
    }
  }
  EXPECT_GT(seen, 300000);
}

TEST(Ceiling, FromWhatIsCalledInsideAWayToTheGoalIsFound) {
  Random random(7);
  int asked = 0;
  for (int map = 0; map < 4; ++map) {
    const CeilingCells cells = random_cells(random, 12, 10, 0.35 + 0.15 * map);
    const CeilingLevel coarse = level_of(cells, 0);
    const CeilingLevel fine = level_of(cells, 1, &coarse);
    for (int i = 0; i < 150; ++i) {
      const Pose at{{cells.side * cells.nx * random.unit(), cells.side * cells.ny * random.unit()},
                    two_pi * random.unit()};
      if (place_at(cells, at.place) != Place::free) continue;
      if (!claimed(fine.lattice, fine.inside, at)) continue;
      EXPECT_FALSE(claimed(fine.lattice, fine.lost, at));
      ++asked;
      EXPECT_TRUE(finds_goal(cells, fine, at))
          << map << ": " << at.place.x << " " << at.place.y << " " << at.heading;
    }
  }
  EXPECT_GT(asked, 200);
}

TEST(Ceiling, KnowsHowNearAWallAVehicleMayFlyTowardsIt) {
  // Towards a wall as far away as the vehicle turns wide: nearer is lost, farther is not.
  const CeilingCells cells = cells_of(room, 0.5);
  const CeilingLevel coarse = level_of(cells, 0);
  const CeilingLevel level = level_of(cells, 1, &coarse);
  const double wall = 0.5;
  for (const double x : {3.0, 4.0, 5.0}) {
    EXPECT_TRUE(claimed(level.lattice, level.lost, {{x, wall + 0.8}, 1.5 * pi}));
    EXPECT_FALSE(claimed(level.lattice, level.lost, {{x, wall + 1.01}, 1.5 * pi}));
    EXPECT_TRUE(claimed(level.lattice, level.inside, {{x, wall + 1.3}, 1.5 * pi}));
    EXPECT_FALSE(claimed(level.lattice, level.inside, {{x, wall + 0.99}, 1.5 * pi}));
  }
}

TEST(Ceiling, AWalledPocketIsLostAndADeadEndKeepsWhoLooksInside) {
  std::vector<std::string> rows(10, std::string(30, '#'));
  for (std::size_t y = 1; y < 9; ++y) rows[y].replace(18, 11, 11, '.');
  rows[4].replace(23, 2, "GG");
  rows[5].replace(23, 2, "GG");
  for (std::size_t y = 4; y < 7; ++y) rows[y].replace(1, 17, 17, '.');  // a street into the room
  rows[1].replace(2, 12, 12, '.');                                      // and one into nowhere
  const Ceiling ceiling = ceiling_of(cells_of(rows, 0.5), 2);
  const auto lost = [&](int ix, int iy, double heading) {
    const int k = static_cast<int>(heading / two_pi * ceiling.headings);
    return ceiling.lost[(static_cast<std::size_t>(k) * 10 + static_cast<std::size_t>(iy)) * 30 +
                        static_cast<std::size_t>(ix)];
  };
  for (int ix = 2; ix < 14; ++ix) {
    for (const double heading : {0.1, 1.6, 3.2, 4.7}) EXPECT_EQ(lost(ix, 8, heading), 1.0F);
  }
  // The street is 1.5 radii wide: no room to turn round.
  EXPECT_EQ(lost(8, 4, pi + 0.05), 1.0F);
  EXPECT_EQ(lost(8, 4, 0.05), 0.0F);
}

TEST(Ceiling, MoreObstaclesNeverLeaveMore) {
  Random random(3);
  for (int i = 0; i < 3; ++i) {
    CeilingCells cells = random_cells(random, 12, 11, 0.5);
    const CeilingLevel before = level_of(cells, 1);
    const auto added = static_cast<std::size_t>(random.unit() * 132.0);
    if (!cells.ordinary(added)) continue;
    cells.obstacle[added] = 1;
    const CeilingLevel after = level_of(cells, 1);
    for (std::size_t n = 0; n < before.inside.size(); ++n) {
      ASSERT_GE(before.inside[n], after.inside[n]);
      ASSERT_LE(before.lost[n], after.lost[n]);
    }
  }
}

TEST(Ceiling, FinerLevelsOnlyTighten) {
  const CeilingCells cells = cells_of(room, 0.45);
  const CeilingShare one = ceiling_of(cells, 1).all;
  const CeilingShare two = ceiling_of(cells, 2).all;
  const CeilingShare three = ceiling_of(cells, 3).all;
  EXPECT_LT(one.lower, two.lower);
  EXPECT_LT(two.lower, three.lower);
  EXPECT_GT(one.upper, two.upper);
  EXPECT_GT(two.upper, three.upper);
  EXPECT_LT(three.upper - three.lower, 0.05);
  EXPECT_LE(three.lower, three.upper);
}

TEST(Ceiling, MirroredMapHasTheMirroredCeiling) {
  Random random(11);
  const CeilingCells cells = random_cells(random, 13, 10, 0.5);
  CeilingCells mirrored = cells;
  for (int y = 0; y < cells.ny; ++y) {
    for (int x = 0; x < cells.nx; ++x) {
      const auto to = static_cast<std::size_t>(y * cells.nx + x);
      const auto from = static_cast<std::size_t>(y * cells.nx + cells.nx - 1 - x);
      mirrored.obstacle[to] = cells.obstacle[from];
      mirrored.goal[to] = cells.goal[from];
    }
  }
  const CeilingShare a = ceiling_of(cells, 2).all;
  const CeilingShare b = ceiling_of(mirrored, 2).all;
  EXPECT_NEAR(a.lower, b.lower, 2e-3);
  EXPECT_NEAR(a.upper, b.upper, 2e-3);
}

TEST(Ceiling, SharesAreThoseOfTheClaimsAlthoughWallsLieAlongTheNodes) {
  const CeilingCells cells = cells_of(room, 0.5);
  const CeilingLevel level = level_of(cells, 0);
  constexpr int across = 32;  // places of a cell, along each axis
  double told = 0.0;
  double counted = 0.0;
  double ordinary = 0.0;
  for (std::size_t bin = 0; bin < level.lost_share.size(); ++bin) {
    const std::size_t cell = bin % cells.goal.size();
    if (!cells.ordinary(cell)) continue;
    ordinary += 1.0;
    told += static_cast<double>(level.lost_share[bin]);
    const double heading =
        (static_cast<double>(bin / cells.goal.size()) + 0.5) * level.lattice.bin_rad;
    const Vec2 corner{static_cast<double>(cell % static_cast<std::size_t>(cells.nx)),
                      static_cast<double>(cell / static_cast<std::size_t>(cells.nx))};
    int lost = 0;
    for (int i = 0; i < across * across; ++i) {
      const Vec2 within{(i % across + 0.5) / across, (i / across + 0.5) / across};
      if (claimed(level.lattice, level.lost, {cells.side * (corner + within), heading})) ++lost;
    }
    counted += static_cast<double>(lost) / (across * across);
  }
  EXPECT_NEAR(told / ordinary, counted / ordinary, 1e-3);
}

TEST(Ceiling, DoesNotDependOnThreads) {
  Random random(5);
  const CeilingCells cells = random_cells(random, 20, 16, 0.4);
  Ceiling alone;
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    alone = ceiling_of(cells, 2);
  }
  const Ceiling together = ceiling_of(cells, 2);
  EXPECT_EQ(alone.inside, together.inside);
  EXPECT_EQ(alone.lost, together.lost);
}

TEST(Ceiling, WithoutAGoalNothingIsInsideAndAllIsLost) {
  CeilingCells cells = cells_of(room, 0.5);
  cells.goal.assign(cells.goal.size(), 0);
  const Ceiling ceiling = ceiling_of(cells, 1);
  EXPECT_EQ(ceiling.all.lower, 0.0);
  EXPECT_EQ(ceiling.all.upper, 0.0);
}

TEST(Ceiling, OfAGridOfOneCellNothingIsAsked) {
  for (const char c : {'#', 'G'}) {
    const Ceiling ceiling = ceiling_of(cells_of({std::string(1, c)}, 0.5), 2);
    EXPECT_EQ(ceiling.all.lower, 0.0);
    EXPECT_EQ(ceiling.all.upper, 1.0);
  }
  // An ordinary one is left, whatever is flown; what lies beyond a grid is not looked at closely.
  const Ceiling left = ceiling_of(cells_of({"."}, 0.5), 2);
  EXPECT_EQ(left.all.lower, 0.0);
  EXPECT_LT(left.all.upper, 0.5);
}

TEST(Ceiling, AStopBeforeTheEndClaimsNothing) {
  const CeilingCells cells = cells_of(room, 0.5);
  CeilingProgress progress;
  progress.stop = [] { return true; };
  const Ceiling ceiling = find_ceiling({cells.nx, cells.ny, 0.0, 0.0, 0.5}, region_of(cells),
                                       Vehicle{1.0, 1.0}, {}, progress);
  EXPECT_FALSE(ceiling.complete);
  EXPECT_EQ(ceiling.all.lower, 0.0);
  EXPECT_EQ(ceiling.all.upper, 1.0);
}

}  // namespace fairway
