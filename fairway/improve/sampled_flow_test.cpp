#include "fairway/improve/sampled_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

std::vector<CommandChange> random_changes(const Plan& plan, const PlanFlow& owner, Random& random) {
  std::vector<CommandChange> changes;
  for (std::uint64_t n = 1 + random.below(3); n > 0; --n) {
    const std::size_t cell = random.below(plan.grid.size());
    if (owner.kind[cell] != CellKind::ordinary) continue;
    const bool axis = random.below(4) == 0;
    const double h =
        axis ? static_cast<double>(random.below(4)) * (pi / 2) - pi / 2 : random.uniform(-pi, pi);
    changes.push_back({cell, Heading::stored(h)});
  }
  return changes;
}

TEST(SampledFlow, AfterChangesItIsAsIfMadeOfTheNewCommands) {
  int differing = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Plan plan = seed % 4 == 3 ? odd_plan(seed) : random_plan(seed);
    const PlanFlow owner(plan);
    const SampledFlowOptions options{4 + static_cast<int>(seed % 5), 24, 120, seed % 3 == 0};
    SampledFlow flow(owner.flow(), options);
    SampledFlow::Trial trial(flow);
    Random random(seed);
    for (int round = 0; round < 12; ++round) {
      const auto changes = random_changes(plan, owner, random);
      const ModelChange told = trial.ask(changes);
      const std::int64_t reached = flow.reached();
      const std::int64_t borders = flow.borders();
      const std::int64_t tears = flow.tears();
      EXPECT_EQ(trial.ask(changes).reached, told.reached);  // asking changes nothing
      flow.apply(changes);
      trial.follow(changes);
      for (const CommandChange& change : changes)
        plan.heading_rad[change.cell] = change.heading_rad;
      const SampledFlow afresh(owner.flow(), options);
      ASSERT_EQ(flow.reached(), afresh.reached()) << "seed " << seed << ", round " << round;
      ASSERT_EQ(flow.borders(), afresh.borders()) << "seed " << seed << ", round " << round;
      ASSERT_EQ(flow.tears(), afresh.tears()) << "seed " << seed << ", round " << round;
      ASSERT_EQ(flow.starts(), afresh.starts());
      ASSERT_EQ(reached + told.reached, flow.reached()) << "seed " << seed << ", round " << round;
      ASSERT_EQ(borders + told.borders, flow.borders()) << "seed " << seed << ", round " << round;
      ASSERT_EQ(tears + told.tears, flow.tears()) << "seed " << seed << ", round " << round;
      differing += told.reached != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(differing, 50);
}

/// One flight after another: with many nodes the model tells nearly what exact flights do.
TEST(SampledFlow, ItsShareIsThatOfExactFlights) {
  for (const std::uint64_t seed : {1, 4, 7, 13, 19, 22}) {  // not the rough ones
    const Plan plan = random_plan(seed);
    const PlanFlow owner(plan);
    SampledFlow flow(owner.flow(), {64, 512, 2000});
    const ExactFlights flights(plan);
    Random random(seed);
    int reach = 0;
    int starts = 0;
    for (std::size_t cell = 0; cell < plan.grid.size(); ++cell) {
      if (owner.kind[cell] != CellKind::ordinary) continue;
      const Vec2 corner = plan.grid.corner(plan.grid.cell_at(cell));
      for (int k = 0; k < 512; ++k, ++starts) {
        const State state{corner + plan.grid.cell_m * Vec2{random.unit(), random.unit()},
                          Heading::from_rad(random.uniform(-pi, pi))};
        reach += flights.fly(state).outcome == Outcome::reach ? 1 : 0;
      }
    }
    const double share = static_cast<double>(flow.reached()) / static_cast<double>(flow.starts());
    EXPECT_NEAR(share, static_cast<double>(reach) / starts, 0.03) << "seed " << seed;
  }
}

TEST(SampledFlow, OfAPathThoseReachWhoFlyAlongIt) {
  // A column of target cells that point up; everywhere else commands point right, across it.
  Plan plan = empty_plan(7, 9, 1.0, 1.5);
  for (int iy = 0; iy < 9; ++iy) {
    plan.region[plan.grid.index({3, iy})] = Region::goal;
    plan.heading_rad[plan.grid.index({3, iy})] = Heading::stored(pi / 2);
  }
  const PlanFlow owner(plan);
  const SampledFlow touched(owner.flow());
  const SampledFlow followed(owner.flow(), {16, 64, 500, true});
  EXPECT_GT(followed.reached(), 0);
  EXPECT_LT(followed.reached(), touched.reached());
  // Where the cells of the path point across it, too, crossing it is flying along their commands.
  for (int iy = 0; iy < 9; ++iy) plan.heading_rad[plan.grid.index({3, iy})] = 0.0F;
  const SampledFlow crossed(owner.flow(), {16, 64, 500, true});
  EXPECT_GT(crossed.reached(), followed.reached());
}

TEST(SampledFlow, ACellWithoutCommandsHasNoNodesAndIsCrossedStraight) {
  Plan plan = empty_plan(3, 1, 1.0, 2.0);
  plan.heading_rad.assign(3, std::numeric_limits<float>::quiet_NaN());
  plan.region[2] = Region::goal;
  const PlanFlow owner(plan);
  SampledFlow flow(owner.flow(), {8, 4000, 50});
  // From a state in a row of two cells straight through the far end.
  std::int64_t hits = 0;
  Random random(5);
  for (int k = 0; k < 200000; ++k) {
    const double x = 2.0 * random.unit();
    const double y = random.unit();
    const double h = random.uniform(-pi, pi);
    if (std::cos(h) <= 0.0) continue;
    const double at = y + (2.0 - x) * std::tan(h);
    hits += at > 0.0 && at < 1.0 ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(flow.reached()) / 8000.0, static_cast<double>(hits) / 200000.0,
              0.01);
}

TEST(SampledFlow, RefusesWhatItCannotModel) {
  Plan plan = empty_plan(2, 2, 2.0, 2.0);
  EXPECT_THROW(SampledFlow(PlanFlow(plan).flow()), PreconditionViolation);
  plan.vehicle.turn_radius_m = 3.0;
  EXPECT_THROW(SampledFlow(PlanFlow(plan).flow(), {0, 1, 1}), PreconditionViolation);
  EXPECT_THROW(SampledFlow(PlanFlow(plan).flow(), {1, 2'000'000'000, 1}), PreconditionViolation);
  plan.region[1] = Region::obstacle;
  SampledFlow flow(PlanFlow(plan).flow(), {2, 2, 10});
  const CommandChange change{1, 0.0F};
  EXPECT_THROW((void)SampledFlow::Trial(flow).ask({&change, 1}), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
