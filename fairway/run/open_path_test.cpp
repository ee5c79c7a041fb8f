// Open paths in empty water: from everywhere they are reached, and nothing circles for ever.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "fairway/base/random.hpp"
#include "fairway/run/plan_map.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/vehicle/path_troubles.hpp"

namespace fairway {
namespace {

constexpr double width_m = 700.0;
constexpr double height_m = 560.0;

ObstacleMap empty_water(double cell_m) {
  ObstacleMap map;
  map.grid = {static_cast<int>(width_m / cell_m), static_cast<int>(height_m / cell_m), 0.0, 0.0,
              cell_m};
  map.obstacle.assign(map.grid.size(), 0);
  return map;
}

Plan plan_of(const PathMission& path, double cell_m, double turn_radius_m,
             const FieldOptions& options = {}) {
  return std::get<Plan>(plan_map(empty_water(cell_m), {10.0, turn_radius_m}, path, options));
}

struct Count {
  std::size_t trapped = 0;
  std::size_t others = 0;  // from starts too far inside to be carried over the edge
};

Count failures(const Plan& plan, std::size_t flights, std::uint64_t seed) {
  Random random(seed);
  const double room_m = 3.0 * plan.vehicle.turn_radius_m;
  std::vector<State> starts;
  for (std::size_t k = 0; k < flights; ++k) {
    starts.push_back(
        {{random.uniform(room_m, width_m - room_m), random.uniform(room_m, height_m - room_m)},
         Heading::from_rad(random.uniform(-pi, pi))});
  }
  Count count;
  for (const FlightResult& r : ExactFlights(plan).fly_all(starts)) {
    count.trapped += r.outcome == Outcome::trapped ? 1 : 0;
    count.others += r.outcome != Outcome::trapped && r.outcome != Outcome::reach ? 1 : 0;
  }
  return count;
}

PathMission reversed(PathMission path) {
  std::reverse(path.vertices_m.begin(), path.vertices_m.end());
  return path;
}

const PathMission straight{{{200.0, 280.0}, {500.0, 280.0}}, false};
const PathMission angled{{{230.0, 200.0}, {430.0, 200.0}, {430.0, 360.0}}, false};

PathMission part_of_a_circle() {
  PathMission path;
  for (int k = 0; k < 50; ++k) {
    const double angle = 0.08 * k;
    path.vertices_m.push_back({350.0 + 100.0 * std::cos(angle), 280.0 + 100.0 * std::sin(angle)});
  }
  return path;
}

/// Gently turning or with a corner or two, far enough from the edges; longer than two radii.
PathMission random_path(Random& random, double turn_radius_m) {
  for (;;) {
    PathMission path;
    const bool smooth = random.below(3) == 0;
    const auto vertices = smooth ? 25 : 2 + random.below(3);
    Vec2 at{random.uniform(200.0, 500.0), random.uniform(180.0, 380.0)};
    double heading = random.uniform(-pi, pi);
    for (std::size_t k = 0; k < vertices; ++k) {
      path.vertices_m.push_back(at);
      const double leg_m = turn_radius_m * (smooth ? 0.3 : random.uniform(2.1, 5.0));
      at = at + leg_m * Heading::from_rad(heading).unit();
      heading += smooth ? random.uniform(-0.25, 0.25) : random.uniform(-1.5, 1.5);
    }
    const bool inside = std::all_of(path.vertices_m.begin(), path.vertices_m.end(), [](Vec2 p) {
      return p.x > 130.0 && p.x < 570.0 && p.y > 130.0 && p.y < 430.0;
    });
    if (inside && path_troubles(path, turn_radius_m).empty()) return path;
  }
}

TEST(OpenPath, IsReachedFromEverywhereWhateverCellsAndRadius) {
  for (const PathMission& path : {straight, angled, part_of_a_circle()}) {
    for (const double cell_m : {2.0, 4.0, 8.0}) {
      for (const double turn_radius_m : {20.0, 40.0}) {
        for (const PathMission& way : {path, reversed(path)}) {
          const Count count = failures(plan_of(way, cell_m, turn_radius_m), 500, 41);
          EXPECT_EQ(count.trapped, 0U) << "cells of " << cell_m << ", radius " << turn_radius_m;
          EXPECT_EQ(count.others, 0U) << "cells of " << cell_m << ", radius " << turn_radius_m;
        }
      }
    }
  }
}

TEST(OpenPath, IsReachedFromEverywhereWhateverItsShapeAndTheFieldsParameters) {
  Random random(42);
  for (int draw = 0; draw < 60; ++draw) {
    const double turn_radius_m = random.uniform(10.0, 40.0);
    FieldOptions options;
    options.mu_path = random.uniform(0.05, 1.0);
    options.sigma_path = random.uniform(0.2, 3.0);
    options.sigma_cells = random.uniform(0.0, 3.0);
    options.metric = random.below(3) == 0 ? Metric::octile : Metric::euclidean;
    options.path_field = draw % 3 == 0 ? PathField::paper : PathField::follow;
    if (draw % 3 == 1) options.blend = Blend::paper;
    const double cell_m = std::min(random.uniform(2.5, 9.0), 0.6 * turn_radius_m);
    const PathMission path = random_path(random, turn_radius_m);
    const Count count = failures(plan_of(path, cell_m, turn_radius_m, options), 400, 43);
    EXPECT_EQ(count.trapped, 0U) << "draw " << draw << ", radius " << turn_radius_m;
  }
}

TEST(OpenPath, IsProvedToTrapNothing) {
  CertifyOptions options;
  options.samples = 20000;
  options.undecided_max = 0.02;
  options.last_level = 7;
  for (const PathMission& path : {straight, angled}) {
    const Verification proof = verify_plan(plan_of(path, 20.0, 45.0), "", {}, options);
    const auto& share = proof.outcome.volume.free;
    EXPECT_EQ(share[static_cast<std::size_t>(Verdict::trapped)], 0.0);
    EXPECT_LT(share[static_cast<std::size_t>(Verdict::undecided)], 0.05);
    EXPECT_GT(share[static_cast<std::size_t>(Verdict::reach)], 0.8);  // the others leave
  }
}

TEST(OpenPath, UnderThePapersBlendFlightsCircleBeyondItsEnd) {
  // As the paper has it, whose paths have no end: kept by that name.
  FieldOptions options;
  options.blend = Blend::paper;
  options.path_field = PathField::paper;
  EXPECT_GT(failures(plan_of(straight, 8.0, 20.0, options), 500, 44).trapped, 10U);
  options.path_field = PathField::follow;
  EXPECT_EQ(failures(plan_of(straight, 8.0, 20.0, options), 500, 44).trapped, 0U);
}

TEST(OpenPath, ThatFitsIntoATurnIsTheOneThatMayBeCircledAndIsTold) {
  const PathMission dot{{{340.0, 280.0}, {360.0, 280.0}}, false};
  EXPECT_GT(failures(plan_of(dot, 2.0, 40.0), 2000, 45).trapped, 0U);
  EXPECT_EQ(path_troubles(dot, 40.0).front().kind, PathTrouble::Kind::fits_into_a_turn);
}

}  // namespace
}  // namespace fairway
