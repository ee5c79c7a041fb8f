// Who is proved to follow a path joins it, stays on it and goes round, whatever it does within the
// contract.
#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"
#include "fairway/inclusion/contract_lookup.hpp"
#include "fairway/inclusion/follow_prover.hpp"
#include "fairway/inclusion/testing/behaviour.hpp"
#include "fairway/vehicle/filled_commands.hpp"

namespace fairway {
namespace {

constexpr double radius_m = 20.0;

/// A closed path in open water, and commands that approach it on circles.
struct Lap {
  explicit Lap(Random& random, double circle_m = 60.0) : path(mission(random)) {
    grid.nx = 50;
    grid.ny = 46;
    grid.cell_m = 8.0;
    kind.assign(grid.size(), CellKind::ordinary);
    const bool right = random.below(2) == 0;  // the way round
    obey_path(circle_m);
    if (right) turn_round();
  }

  void obey_path(double circle_m) {
    heading.clear();
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const PathFrame frame = path.frame(grid.center(grid.cell_at(i)));
      const double off = std::acos(1.0 - std::min(1.0, std::abs(frame.offset_m) / circle_m));
      const double tangent = std::atan2(frame.tangent.y, frame.tangent.x);
      heading.push_back(static_cast<float>(
          std::remainder(tangent + (frame.offset_m > 0.0 ? -off : off), 2.0 * pi)));
    }
  }

  static PathMission mission(Random& random) {
    PathMission path;
    path.closed = true;
    const double a = random.uniform(100.0, 140.0);
    const double b = random.uniform(95.0, 120.0);
    for (int k = 0; k < 90; ++k) {
      const double at = 2.0 * pi * k / 90.0;
      path.vertices_m.push_back({200.0 + a * std::cos(at), 184.0 + b * std::sin(at)});
    }
    return path;
  }
  /// The mirror image, so that the path is driven the other way round.
  void turn_round() {
    PathMission mirrored = path.path();
    for (Vec2& v : mirrored.vertices_m) v.y = grid.ny * grid.cell_m - v.y;
    path = PathLocator(mirrored);
    std::vector<float> other(heading.size());
    for (std::size_t i = 0; i < heading.size(); ++i) {
      const Cell c = grid.cell_at(i);
      other[grid.index({c.ix, grid.ny - 1 - c.iy})] = -heading[i];
    }
    heading = other;
  }
  Flow flow() const { return {grid, vehicle, heading.data(), kind.data()}; }

  PathLocator path;
  Grid grid;
  Vehicle vehicle{10.0, radius_m};
  std::vector<float> heading;
  std::vector<CellKind> kind;
};

VehicleContract some_contract(Random& random, const Vehicle& vehicle) {
  VehicleContract contract = VehicleContract::of(vehicle);
  contract.command_error_m = random.uniform(0.0, 3.0);
  contract.heading_error_rad = random.uniform(0.001, 0.03);
  const double spread = random.uniform(0.0, 0.08);
  contract.turn_radius_m = {radius_m * (1.0 - spread), radius_m * (1.0 + spread)};
  contract.speed_mps = {9.0, 11.0};
  return contract;
}

struct Proof {
  Proof(const Lap& lap, const VehicleContract& contract, const FollowOptions& options = {})
      : parts(lap.flow(), contract, 2),
        tube(parts, lap.grid, lap.path, 40.0),
        prover(parts, tube, options),
        found(prover.find_core(contract.speed_mps)) {}

  Parts parts;
  Tube tube;
  FollowProver prover;
  std::optional<Following> found;
};

TEST(FollowProver, BehavioursJoinInTimeStayAndGoRound) {
  Random random(11);
  int flown = 0;
  for (int round = 0; round < 4; ++round) {
    const Lap lap(random);
    const VehicleContract contract = some_contract(random, lap.vehicle);
    Proof proof(lap, contract);
    ASSERT_TRUE(proof.found) << round;
    EXPECT_LT(proof.found->tube_m, 1.2 * radius_m);
    ASSERT_TRUE(proof.prover.join([](const InclusionLevel&) {}));
    const ContractVerdicts verdicts = proof.prover.joining().verdicts(contract.speed_mps.least);
    const Flow flow = lap.flow();
    const auto commands = filled_commands(lap.grid, lap.heading.data());
    const double length_m = lap.path.length_m();
    const auto stretches = static_cast<double>(proof.found->tube.size());
    for (int k = 0; k < 60; ++k) {
      const Vec2 p{random.uniform(80.0, 320.0), random.uniform(80.0, 290.0)};
      const double heading = random.uniform(-pi, pi);
      const ContractAnswer answer =
          contract_answer(proof.parts, verdicts, contract.speed_mps.least,
                          {p.x / proof.parts.part_m(), p.y / proof.parts.part_m()}, heading);
      if (answer.verdict != Verdict::reach) continue;
      ++flown;
      Behaviour behaviour(flow, commands, contract, p, heading, random.bits());
      constexpr double step_m = 0.5;
      // No faster than the bounds say, no slower.
      const double joining_m = answer.worst_time_s * contract.speed_mps.least;
      const double lap_m = proof.found->lap_most_s * contract.speed_mps.least;
      double way_m = 0.0;
      while (way_m < joining_m) {
        behaviour.step(step_m);
        way_m += step_m;
      }
      double before_m = lap.path.frame(behaviour.place()).station_m;
      double round_m = 0.0;  // along the path
      double lap_began_m = way_m;
      for (int laps = 0; laps < 3;) {
        behaviour.step(step_m);
        way_m += step_m;
        const PathFrame frame = lap.path.frame(behaviour.place());
        const auto stretch = static_cast<std::size_t>(
            std::min(stretches - 1.0, frame.station_m / length_m * stretches));
        const TubeStretch& bound = proof.found->tube[stretch];
        ASSERT_LE(std::abs(frame.offset_m), bound.distance_m) << round << ", " << k;
        const double off = std::remainder(
            behaviour.heading_rad() - std::atan2(frame.tangent.y, frame.tangent.x), 2.0 * pi);
        ASSERT_LE(std::abs(off), bound.off_rad) << round << ", " << k;
        const double on_m = std::remainder(frame.station_m - before_m, length_m);
        ASSERT_GE(on_m, -1e-9) << round << ", " << k;
        before_m = frame.station_m;
        round_m += on_m;
        ASSERT_LE(way_m - lap_began_m, lap_m + step_m) << "late, " << round << ", " << k;
        if (round_m < length_m) continue;
        EXPECT_GE(way_m - lap_began_m + step_m, proof.found->lap_least_s * contract.speed_mps.most);
        round_m -= length_m;
        lap_began_m = way_m;
        ++laps;
      }
    }
  }
  EXPECT_GT(flown, 150);
}

TEST(FollowProver, CommandsAcrossThePathFollowNothing) {
  Random random(12);
  const Lap lap(random, 0.5);  // a right angle from half a metre on
  EXPECT_FALSE(Proof(lap, VehicleContract::of(lap.vehicle)).found);
}

TEST(FollowProver, CommandsAgainstThePathFollowNothing) {
  Random random(13);
  Lap lap(random);
  PathMission back = lap.path.path();
  std::reverse(back.vertices_m.begin(), back.vertices_m.end());
  lap.path = PathLocator(back);
  EXPECT_FALSE(Proof(lap, VehicleContract::of(lap.vehicle)).found);
}

TEST(FollowProver, APathThroughAnObstacleIsNotFollowed) {
  Random random(14);
  for (int round = 0; round < 2; ++round) {
    Lap lap(random);
    const Vec2 on = lap.path.path().vertices_m[static_cast<std::size_t>(random.below(90))];
    lap.kind[lap.grid.index(lap.grid.cell_of(on))] = CellKind::obstacle;
    EXPECT_FALSE(Proof(lap, some_contract(random, lap.vehicle)).found) << round;
  }
}

TEST(FollowProver, APathWithALoopBesideItselfIsNotSaidToBeGoneRound) {
  // Where the loop leaves the great circle both run the same way: who obeys may stay in the loop
  // for ever, or never come into it, though the nearest point of the path always moves on.
  Random random(16);
  for (const double loop_m : {42.0, 60.0}) {
    Lap lap(random);
    PathMission path;
    path.closed = true;
    for (int k = 0; k < 120; ++k) {
      const double at = 2.0 * pi * k / 120.0;
      path.vertices_m.push_back({200.0 + 135.0 * std::cos(at), 184.0 + 135.0 * std::sin(at)});
      for (int i = 1; k == 0 && i < 60; ++i) {
        const double in = 2.0 * pi * i / 60.0;
        path.vertices_m.push_back(
            {335.0 - loop_m + loop_m * std::cos(in), 184.0 + loop_m * std::sin(in)});
      }
    }
    lap.path = PathLocator(path);
    lap.obey_path(60.0);
    EXPECT_FALSE(Proof(lap, VehicleContract::of(lap.vehicle)).found) << loop_m;
  }
}

TEST(FollowProver, GoesOnFromAnEarlierProofWhereverThatWasInterrupted) {
  Random random(17);
  const Lap lap(random);
  const VehicleContract contract = some_contract(random, lap.vehicle);
  const double speed_mps = contract.speed_mps.least;
  Proof whole(lap, contract);
  ASSERT_TRUE(whole.found && whole.prover.join([](const InclusionLevel&) {}));
  const auto decided = [](const ContractVerdicts& v) {
    return std::count_if(v.verdict.begin(), v.verdict.end(), [](auto one) { return one != 0; });
  };
  const auto proved_whole = whole.prover.proved(speed_mps);
  for (const int rounds : {1, 2, 4}) {
    int round = 0;
    FollowOptions options;
    options.limits.go_on = [&] { return round < rounds; };
    Proof part(lap, contract, options);
    ASSERT_TRUE(part.found);
    ASSERT_FALSE(part.prover.join([&](const InclusionLevel&) { ++round; }));
    const auto earlier = part.prover.proved(speed_mps);
    Proof on(lap, contract);
    ASSERT_TRUE(on.found && on.prover.join([](const InclusionLevel&) {}, &earlier.verdicts));
    const auto now = on.prover.proved(speed_mps);
    EXPECT_LT(decided(earlier.verdicts), decided(proved_whole.verdicts));
    EXPECT_GT(decided(now.verdicts), 95 * decided(proved_whole.verdicts) / 100);
    // The core is that of every proof, and what joined it joins it again.
    EXPECT_EQ(on.found->core, whole.found->core);
    EXPECT_EQ(now.proof.tube.size(), proved_whole.proof.tube.size());
    std::size_t core = 0;
    for (const auto stage : now.proof.leaf_stage) core += stage != 0 ? 1 : 0;
    EXPECT_EQ(core, whole.found->core);
    for (std::size_t s = 0; s + 1 < earlier.verdicts.first.size(); ++s) {
      for (std::size_t k = earlier.verdicts.first[s]; k < earlier.verdicts.first[s + 1]; ++k) {
        if (earlier.verdicts.verdict[k] == 0) continue;
        const auto at = std::upper_bound(now.verdicts.begin.begin() + now.verdicts.first[s],
                                         now.verdicts.begin.begin() + now.verdicts.first[s + 1],
                                         earlier.verdicts.begin[k]) -
                        now.verdicts.begin.begin() - 1;
        ASSERT_EQ(now.verdicts.verdict[static_cast<std::size_t>(at)], earlier.verdicts.verdict[k]);
      }
    }
  }
}

TEST(FollowProver, MoreErrorsMakeTheTubeNoNarrower) {
  Random random(15);
  const Lap lap(random);
  VehicleContract contract = VehicleContract::of(lap.vehicle);
  double before_m = 0.0;
  for (const double error : {0.0005, 0.01, 0.03}) {
    contract.heading_error_rad = error;
    contract.command_error_m = 60.0 * error;
    const Proof proof(lap, contract);
    ASSERT_TRUE(proof.found);
    EXPECT_GE(proof.found->tube_m, before_m);
    before_m = proof.found->tube_m;
  }
}

}  // namespace
}  // namespace fairway
