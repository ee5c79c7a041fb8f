#include "fairway/bitmap/bitmap_backward.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/bitmap/bitmap_expansion.hpp"
#include "fairway/bitmap/bitmap_graph.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {
namespace {

/// Commands from `heading_rad(centre of the cell)`; cells of side 1, everything free.
template <typename Field>
Plan plan_of(int nx, int ny, double turn_radius_m, const Field& heading_rad) {
  Plan plan;
  plan.grid = {nx, ny, 0.0, 0.0, 1.0};
  plan.vehicle = {1.0, turn_radius_m};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 0.0F);
  for (std::size_t i = 0; i < plan.grid.size(); ++i)
    plan.heading_rad.push_back(
        static_cast<float>(heading_rad(plan.grid.center(plan.grid.cell_at(i)))));
  return plan;
}

std::vector<std::uint8_t> only(const Plan& plan, std::initializer_list<Cell> cells) {
  std::vector<std::uint8_t> target(plan.grid.size());
  for (const Cell c : cells) target[plan.grid.index(c)] = 1;
  return target;
}

/// Headings anywhere or on eighths, cells without command, obstacles.
Plan random_plan(Random& random) {
  const int nx = 1 + static_cast<int>(random.below(6));
  const int ny = 1 + static_cast<int>(random.below(6));
  const bool eighths = random.below(3) == 0;
  Plan plan = plan_of(nx, ny, random.uniform(1.0 + 1e-6, 5.0), [&](Vec2) {
    if (random.below(10) == 0) return std::numeric_limits<double>::quiet_NaN();
    return eighths ? (static_cast<double>(random.below(8)) - 3.0) * pi / 4
                   : random.uniform(-3.14, 3.14);
  });
  for (Region& region : plan.region) {
    const auto kind = random.below(8);
    region = kind == 0 ? Region::obstacle : kind == 1 ? Region::goal : Region::free;
  }
  return plan;
}

/// Where border state bits lie, as (position, heading) in the world.
struct BorderState {
  Vec2 position_m;
  double heading_rad;
  bool reached;
};
std::vector<BorderState> states_of(const BorderBitmap& set) {
  std::vector<BorderState> states;
  const BorderNumbers borders = set.borders();
  for (std::size_t b = 0; b < borders.count(); ++b) {
    const Cell c = borders.cell_before(b);
    for (int k = 0; k < set.samples; ++k) {
      for (int i = 0; i < set.samples; ++i) {
        const double share = (i + 0.5) / set.samples;
        const Vec2 p =
            borders.is_upright(b) ? Vec2{c.ix + 1.0, c.iy + share} : Vec2{c.ix + share, c.iy + 1.0};
        states.push_back({p, (k + 0.5) * two_pi / set.samples, set.reached(b, k, i)});
      }
    }
  }
  return states;
}

TEST(BackwardReachableSet, IsThatOfTheIterativeExpansionBitForBit) {
  Random random(11);
  int mixed = 0;
  for (int draw = 0; draw < 120; ++draw) {
    const Plan plan = random_plan(random);
    const auto asked =
        draw % 4 == 0 ? RegionOfInterest::Kind::obstacle : RegionOfInterest::Kind::goal;
    const auto target = target_cells(plan.grid, plan.region, {asked, {}});
    const BitmapOptions options{draw % 2 == 0 ? 8 : 20};
    const BorderBitmap fast = backward_reachable_set(plan, target, options);
    const BitmapExpansion slow = expand_borders(plan, target, options);
    ASSERT_EQ(fast, slow.set) << "draw " << draw;
    if (fast.share_reached() > 0.1 && fast.share_reached() < 0.9) ++mixed;
  }
  EXPECT_GT(mixed, 30);
}

TEST(BackwardReachableSet, IsTheSameForAnyNumberOfThreads) {
  Random random(5);
  const Plan plan = plan_of(24, 24, 2.5, [&](Vec2 p) {
    return std::atan2(12.0 - p.y, 12.0 - p.x) + random.uniform(-1.2, 1.2);
  });
  const auto target = only(plan, {{12, 12}, {12, 11}, {11, 12}, {11, 11}});
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control bound(tbb::global_control::max_allowed_parallelism, threads);
    return backward_reachable_set(plan, target, {40});
  };
  const BorderBitmap alone = with_threads(1);
  EXPECT_GT(alone.share_reached(), 0.3);
  EXPECT_LT(alone.share_reached(), 1.0);
  for (const std::size_t threads : {2, 3, 8}) EXPECT_EQ(with_threads(threads), alone);
}

TEST(BackwardReachableSet, KeepsMSquaredBitsForEachInnerBorder) {
  const Plan plan = plan_of(20, 20, 2.5, [](Vec2) { return 0.0; });
  const BorderBitmap set = backward_reachable_set(plan, only(plan, {{19, 10}}), {200});
  EXPECT_EQ(set.borders().count() * set.states_per_border(), 30'400'000U);
  EXPECT_EQ(set.bytes(), 3'800'000U);
}

/// The bits that differ, as a share, of two sets whose states correspond.
template <typename Match>
double share_different(const BorderBitmap& a, const BorderBitmap& b, const Match& match) {
  std::size_t different = 0;
  std::size_t all = 0;
  for (std::size_t border = 0; border < a.borders().count(); ++border) {
    for (int k = 0; k < a.samples; ++k) {
      for (int i = 0; i < a.samples; ++i, ++all)
        different += a.reached(border, k, i) != match(b, border, k, i) ? 1 : 0;
    }
  }
  return all > 0 ? static_cast<double>(different) / static_cast<double>(all) : 0.0;
}

// Commands are kept as floats, so a turned command is off by 1e-7 rad: a state within that of the
// end of a piece may be snapped otherwise.
constexpr double by_rounding = 1e-3;

/// Commands along axes and diagonals lie between two samples: turned or mirrored, they may fall to
/// the other one.
Plan off_axes(Plan plan) {
  for (float& heading : plan.heading_rad) heading += 0.01F;
  return plan;
}

TEST(BackwardReachableSet, TurnsWithThePlan) {
  Random random(17);
  const int m = 24;
  for (int draw = 0; draw < 20; ++draw) {
    const Plan plan = off_axes(random_plan(random));
    Plan turned = plan;  // (x, y) to (ny - y, x)
    turned.grid.nx = plan.grid.ny;
    turned.grid.ny = plan.grid.nx;
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      const Cell c = plan.grid.cell_at(i);
      const std::size_t j = turned.grid.index({plan.grid.ny - 1 - c.iy, c.ix});
      turned.region[j] = plan.region[i];
      turned.heading_rad[j] = static_cast<float>(
          Heading::from_rad(static_cast<double>(plan.heading_rad[i]) + pi / 2).rad());
    }
    const auto set = backward_reachable_set(plan, target_cells(plan.grid, plan.region, {}), {m});
    const auto after =
        backward_reachable_set(turned, target_cells(turned.grid, turned.region, {}), {m});
    const auto match = [&](const BorderBitmap& b, std::size_t border, int k, int i) {
      const Cell c = set.borders().cell_before(border);
      const bool upright = set.borders().is_upright(border);
      const Cell before{plan.grid.ny - 1 - c.iy - (upright ? 0 : 1), c.ix};
      return b.reached(b.borders().of(before, upright ? Side::top : Side::right), (k + m / 4) % m,
                       upright ? m - 1 - i : i);
    };
    EXPECT_LE(share_different(set, after, match), by_rounding) << "draw " << draw;
  }
}

TEST(BackwardReachableSet, IsMirroredWithThePlan) {
  Random random(19);
  const int m = 24;
  for (int draw = 0; draw < 20; ++draw) {
    const Plan plan = off_axes(random_plan(random));
    Plan mirrored = plan;  // y to ny - y
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      const Cell c = plan.grid.cell_at(i);
      const std::size_t j = plan.grid.index({c.ix, plan.grid.ny - 1 - c.iy});
      mirrored.region[j] = plan.region[i];
      mirrored.heading_rad[j] = -plan.heading_rad[i];
    }
    const auto set = backward_reachable_set(plan, target_cells(plan.grid, plan.region, {}), {m});
    const auto after =
        backward_reachable_set(mirrored, target_cells(mirrored.grid, mirrored.region, {}), {m});
    const auto match = [&](const BorderBitmap& b, std::size_t border, int k, int i) {
      const Cell c = set.borders().cell_before(border);
      const bool upright = set.borders().is_upright(border);
      const Cell before{c.ix, plan.grid.ny - 1 - c.iy - (upright ? 0 : 1)};
      return b.reached(b.borders().of(before, upright ? Side::right : Side::top), m - 1 - k,
                       upright ? m - 1 - i : i);
    };
    EXPECT_LE(share_different(set, after, match), by_rounding) << "draw " << draw;
  }
}

TEST(BackwardReachableSet, OfAUniformFieldIsKnownInClosedForm) {
  // All turn east, then fly on to the last column, unless the turn leads out of the grid.
  const int n = 12;
  const double r = 2.5;
  const Plan plan = plan_of(n, n, r, [](Vec2) { return 0.0; });
  std::vector<std::uint8_t> target(plan.grid.size());
  for (int iy = 0; iy < n; ++iy) target[plan.grid.index({n - 1, iy})] = 1;
  const BorderBitmap set = backward_reachable_set(plan, target, {60});
  int reached = 0;
  int missed = 0;
  for (const BorderState& s : states_of(set)) {
    const double h = s.heading_rad > pi ? s.heading_rad - two_pi : s.heading_rad;
    const double end_y = s.position_m.y + std::copysign(r * (1.0 - std::cos(h)), h);
    const double most_west =
        std::abs(h) > pi / 2 ? s.position_m.x - r * (1.0 - std::abs(std::sin(h))) : s.position_m.x;
    const double room = std::min({end_y, n - end_y, most_west});  // to the grid's edge
    if (s.position_m.x > n - 1.2 - r || std::abs(room) < 0.5) continue;
    ASSERT_EQ(s.reached, room > 0.0)
        << s.position_m.x << ", " << s.position_m.y << ", " << s.heading_rad;
    ++(s.reached ? reached : missed);
  }
  EXPECT_GT(reached, 100'000);
  EXPECT_GT(missed, 100'000);
}

TEST(BackwardReachableSet, AVortexNeverReachesItsMiddleFromOutside) {
  const int n = 24;
  const double r = 2.0;
  const auto middle = [](Vec2 p) { return Vec2{p.x - 12.0, p.y - 12.0}; };
  for (const double sense : {1.0, -1.0}) {
    const Plan plan = plan_of(
        n, n, r, [&](Vec2 p) { return std::atan2(sense * middle(p).x, -sense * middle(p).y); });
    const BorderBitmap set =
        backward_reachable_set(plan, only(plan, {{11, 11}, {11, 12}, {12, 11}, {12, 12}}), {20});
    EXPECT_GT(set.count_reached(), 0U);
    for (const BorderState& s : states_of(set)) {
      if (norm(middle(s.position_m)) > 3.0 * r) {
        ASSERT_FALSE(s.reached);
      }
    }
  }
}

TEST(BackwardReachableSet, ASourceIsReachedFromNoFartherThanATurnAway) {
  const auto middle = [](Vec2 p) { return Vec2{p.x - 8.0, p.y - 8.0}; };
  const double r = 2.0;
  const Plan plan =
      plan_of(16, 16, r, [&](Vec2 p) { return std::atan2(middle(p).y, middle(p).x); });
  const BorderBitmap set =
      backward_reachable_set(plan, only(plan, {{7, 7}, {7, 8}, {8, 7}, {8, 8}}), {40});
  EXPECT_GT(set.count_reached(), 0U);
  for (const BorderState& s : states_of(set)) {
    if (norm(middle(s.position_m)) > r + std::sqrt(2.0) + 0.5) {
      ASSERT_FALSE(s.reached);
    }
  }
}

TEST(BackwardReachableSet, TwoOpposingHalfPlanesLeadAlongTheirBorder) {
  // Weaving east: every hop leaves by the border it came in by.
  const Plan plan = plan_of(12, 6, 3.0, [](Vec2 p) { return p.y > 3.0 ? -1.0 : 1.0; });
  const auto target = only(plan, {{11, 2}, {11, 3}});
  const int m = 40;
  const BitmapGraph graph(plan, target, m);
  const BorderBitmap set = backward_reachable_set(plan, target, {m});
  int returns = 0;
  for (int ix = 2; ix < 11; ++ix) {
    const std::size_t border = set.borders().of({ix, 2}, Side::top);
    for (const int k : {0, 1, m - 2, m - 1}) {
      for (int i = 0; i < m; ++i) {
        EXPECT_TRUE(set.reached(border, k, i)) << ix << " " << k << " " << i;
        const BitmapGraph::Node node = graph.node_at(border, k, i);
        const BitmapGraph::Node after = graph.successor(node, graph.row_of(node));
        if (graph.border_of(after) == border) ++returns;
      }
    }
  }
  EXPECT_GT(returns, 100);
}

TEST(BackwardReachableSet, OfNothingIsEmptyAndOfEverythingIsEverything) {
  Random random(23);
  for (int draw = 0; draw < 20; ++draw) {
    const Plan plan = random_plan(random);
    const std::vector<std::uint8_t> none(plan.grid.size(), 0);
    const std::vector<std::uint8_t> all(plan.grid.size(), 1);
    EXPECT_EQ(backward_reachable_set(plan, none, {12}).count_reached(), 0U);
    const BorderBitmap whole = backward_reachable_set(plan, all, {12});
    EXPECT_EQ(whole.count_reached(), whole.borders().count() * 144);
  }
}

TEST(BackwardReachableSet, OfOneCellHasNoBorder) {
  const Plan plan = plan_of(1, 1, 2.0, [](Vec2) { return 0.5; });
  const BorderBitmap set = backward_reachable_set(plan, {1}, {8});
  EXPECT_EQ(set.borders().count(), 0U);
  EXPECT_EQ(set.bytes(), 0U);
  EXPECT_EQ(set.share_reached(), 0.0);
}

TEST(BackwardReachableSet, AnObstacleInTheWayIsNotReachedUnlessItIsTheRegion) {
  Plan plan = plan_of(5, 1, 2.0, [](Vec2) { return 0.0; });
  plan.region[2] = Region::obstacle;
  plan.region[4] = Region::goal;
  const BorderBitmap set =
      backward_reachable_set(plan, target_cells(plan.grid, plan.region, {}), {40});
  const BorderBitmap hits = backward_reachable_set(
      plan, target_cells(plan.grid, plan.region, {RegionOfInterest::Kind::obstacle, {}}), {40});
  const auto due_east = [](const BorderBitmap& s, int ix) {
    return s.reached(static_cast<std::size_t>(ix), 0, 20);
  };
  EXPECT_FALSE(due_east(set, 0));
  EXPECT_TRUE(due_east(hits, 0));
  EXPECT_TRUE(due_east(hits, 1));  // enters it
  EXPECT_TRUE(due_east(set, 2));
  EXPECT_FALSE(due_east(hits, 2));
}

TEST(BackwardReachableSet, RefusesWhatDoesNotFit) {
  Plan plan = plan_of(3, 3, 2.0, [](Vec2) { return 0.0; });
  const std::vector<std::uint8_t> target(9, 1);
  EXPECT_THROW(static_cast<void>(backward_reachable_set(plan, {1, 0}, {8})), PreconditionViolation);
  EXPECT_THROW(static_cast<void>(backward_reachable_set(plan, target, {10})),
               PreconditionViolation);
  plan.vehicle.turn_radius_m = 1.0;  // not larger than the cell
  EXPECT_THROW(static_cast<void>(backward_reachable_set(plan, target, {8})), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
