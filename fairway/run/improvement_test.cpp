#include "fairway/run/improvement.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <variant>

#include "fairway/base/error.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/plan/plan_record_json.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/simulate/testing/circuit_plan.hpp"

namespace fairway {
namespace {

constexpr Vehicle vehicle{10.0, 20.0};

/// A wide place with the goal, and a street away from it that is narrower than two turns.
ObstacleMap street(bool closed_in) {
  ObstacleMap map;
  map.grid = {44, 24, 0.0, 0.0, 8.0};
  map.obstacle.assign(map.grid.size(), closed_in ? 1 : 0);
  for (int iy = 1; iy < 23; ++iy) {
    for (int ix = 1; ix < 43; ++ix) {
      const bool open = ix < 22 || (iy > 8 && iy < 16);
      map.obstacle[map.grid.index({ix, iy})] = open ? 0 : 1;
    }
  }
  return map;
}

Plan plan_of(const ObstacleMap& map) {
  FieldOptions options;
  options.alpha = 0.6;
  GoalMission mission;
  mission.goal_m = {80.0, 96.0};
  return plan_of_field(std::get<Field>(compute_field(map, vehicle, mission, options)), vehicle);
}

double proved(const Plan& plan) {
  CertifyOptions options;
  options.undecided_max = 0.01;
  return verify_plan(plan, "plan", {}, options).outcome.volume.all[1];
}

Improvement improved_once(const Plan& plan, ImprovementOptions options = {}) {
  options.sweeps = 1;
  const Progress nobody;
  StageClock clock(nobody);
  return improved(plan, "plan", options, clock);
}

TEST(Improvement, MoreIsProvedInTheNarrowStreet) {
  const Plan plan = plan_of(street(true));
  const Improvement made = improved_once(plan);
  ASSERT_FALSE(made.changed.empty());
  EXPECT_EQ(made.before.exact, proved(plan));
  EXPECT_EQ(made.after.exact, proved(made.plan));
  EXPECT_GT(made.after.exact, made.before.exact_at_most);
  EXPECT_EQ(made.before.under_contract, std::nullopt);
  std::size_t next = 0;
  for (std::size_t cell = 0; cell < plan.grid.size(); ++cell) {
    const bool none = std::isnan(plan.heading_rad[cell]);
    EXPECT_EQ(none, std::isnan(made.plan.heading_rad[cell]));
    if (none || plan.heading_rad[cell] == made.plan.heading_rad[cell]) continue;
    ASSERT_LT(next, made.changed.size());
    EXPECT_EQ(made.changed[next++], cell);
    EXPECT_EQ(plan.region[cell] == Region::free || plan.region[cell] == Region::buffer, true);
  }
  EXPECT_EQ(next, made.changed.size());
  EXPECT_EQ(made.plan.region, plan.region);
  EXPECT_EQ(plan_digests(made.plan).cost_m, plan_digests(plan).cost_m);
}

TEST(Improvement, ItsRecordSaysWhatWasImproved) {
  const Plan plan = plan_of(street(true));
  const Improvement made = improved_once(plan);
  ASSERT_TRUE(made.plan.record.improved.has_value());
  const ImprovedRecord& record = *made.plan.record.improved;
  EXPECT_EQ(record.from_sha256, plan_digests(plan).heading_rad);
  EXPECT_EQ(record.cells_changed, made.changed.size());
  EXPECT_EQ(record.exact, (std::array{made.before.exact, made.after.exact}));
  EXPECT_EQ(plan_record_of(json_of(made.plan.record), "r").improved, made.plan.record.improved);
  EXPECT_FALSE(json_of(plan.record).contains("improved"));
  auto broken = json_of(made.plan.record);
  broken["improved"]["exact"] = {0.5};
  EXPECT_THROW((void)plan_record_of(broken, "r"), InputError);
}

TEST(Improvement, ItDoesNotDependOnTheNumberOfThreads) {
  const Plan plan = plan_of(street(true));
  const auto with = [&](std::size_t threads) {
    const tbb::global_control bound(tbb::global_control::max_allowed_parallelism, threads);
    return plan_digests(improved_once(plan).plan);
  };
  EXPECT_EQ(with(1), with(4));
}

/// A proof that ended early must not make the next one, which went further, look better.
TEST(Improvement, WhatTheFirstProofLeavesUndecidedCountsAsIfItReached) {
  const Plan plan = plan_of(street(true));
  ImprovementOptions options;
  options.undecided_max = 1.0;  // proofs end at once
  const Improvement made = improved_once(plan, options);
  EXPECT_GT(made.before.exact_at_most, made.before.exact + 0.03);
  EXPECT_GT(made.attempts, 0U);
  EXPECT_TRUE(made.changed.empty());
}

TEST(Improvement, OfAPathTheProofOfFollowingDecides) {
  const Plan plan = testing::walled_circuit_plan();
  ImprovementOptions options;
  options.time_limit_s = 0.3;  // for each search: what is asserted holds wherever it ends
  options.most_bend_rad = 0.5;
  const Improvement made = improved_once(plan, options);
  EXPECT_GE(made.after.exact, made.before.exact);
  for (const std::size_t cell : made.changed) EXPECT_NE(plan.region[cell], Region::goal);
  const auto found = findings(plan, made);
  const char* words = made.changed.empty() ? "No better commands" : "join the path";
  EXPECT_NE(found[0].what.find(words), std::string::npos);
}

TEST(Improvement, UnderAContractNeitherShareFalls) {
  Plan plan = plan_of(street(true));
  plan.record.contract = VehicleContract::of(vehicle);
  plan.record.contract->command_error_m = 2.0;
  plan.record.contract->heading_error_rad = 0.02;
  plan.record.contract->turn_radius_m = {19.0, 21.0};
  const Improvement made = improved_once(plan);
  ASSERT_TRUE(made.before.under_contract && made.after.under_contract);
  EXPECT_GE(*made.after.under_contract, *made.before.under_contract);
  EXPECT_GE(made.after.exact, made.before.exact);
  EXPECT_EQ(findings(plan, made).size(), made.changed.empty() ? 1U : 3U);
}

TEST(Improvement, WhereAllReachNothingIsChanged) {
  Plan plan = plan_of(street(true));
  for (Region& region : plan.region) region = region == Region::obstacle ? region : Region::goal;
  const Improvement made = improved_once(plan);
  EXPECT_TRUE(made.changed.empty());
  EXPECT_EQ(plan_digests(made.plan), plan_digests(plan));
  EXPECT_FALSE(made.plan.record.improved.has_value());
}

TEST(Improvement, CommandsBendNoMoreThanIsAllowed) {
  const Plan plan = plan_of(street(true));
  ImprovementOptions options;
  options.most_bend_rad = 0.3;
  const Improvement made = improved_once(plan, options);
  for (const std::size_t cell : made.changed) {
    const Cell at = plan.grid.cell_at(cell);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell c{at.ix + dx, at.iy + dy};
        if (!plan.grid.contains(c)) continue;
        const std::size_t next = plan.grid.index(c);
        const auto bend = [&](const Plan& p) {
          return angle_between(p.heading_rad[cell], p.heading_rad[next]);
        };
        const bool ordinary =
            plan.region[next] == Region::free || plan.region[next] == Region::buffer;
        if (!ordinary || std::isnan(bend(plan))) continue;
        EXPECT_LE(bend(made.plan), std::max(0.3, bend(plan)) + 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace fairway
