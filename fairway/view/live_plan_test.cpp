#include "fairway/view/live_plan.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"
#include "fairway/run/plan_map.hpp"
#include "fairway/view/question.hpp"

namespace fairway {
namespace {

/// A walled field of 60 x 50 cells of 4 m with a rock in it.
Plan walled(const Mission& mission) {
  ObstacleMap map;
  map.grid = {60, 50, -20.0, 10.0, 4.0};
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    const Cell c = map.grid.cell_at(i);
    const bool wall = c.ix == 0 || c.iy == 0 || c.ix == 59 || c.iy == 49;
    const bool rock = c.ix > 25 && c.ix < 31 && c.iy > 20 && c.iy < 28;
    map.obstacle.push_back(wall || rock ? 1 : 0);
  }
  FieldOptions options;
  options.alpha = 1.0;
  return std::get<Plan>(plan_map(map, {10.0, 9.0}, mission, options));
}

const Vec2 home{150.0, 60.0};
const Vec2 elsewhere{40.0, 160.0};

std::shared_ptr<const LivePlan> plan_to(const MovedGoals& goals, Vec2 goal_m) {
  return std::get<std::shared_ptr<const LivePlan>>(goals.plan_to(goal_m));
}

TEST(MovedGoals, AreThePlansOfTheirGoalsAndAreRemembered) {
  const Plan plan = walled(GoalMission{home, 0.5});
  const MovedGoals goals(plan);
  EXPECT_EQ(goals.refusal(), "");
  const auto same = plan_to(goals, home);
  EXPECT_EQ(same->plan.cost_m, plan.cost_m);
  EXPECT_EQ(json_text(same->plan.record), json_text(plan.record));
  const auto other = plan_to(goals, elsewhere);
  EXPECT_NE(other->plan.cost_m, plan.cost_m);
  EXPECT_EQ(other->plan.record.mission, Mission(GoalMission{elsewhere, 0.5}));
  EXPECT_EQ(plan_to(goals, elsewhere), other);
  EXPECT_EQ(other->proof(), nullptr) << "verdicts of the folder's plan are not this plan's";
}

TEST(MovedGoals, NoMoreAreKeptThanTheLimit) {
  const Plan plan = walled(GoalMission{home, {}});
  ReplanLimits limits;
  limits.kept = 2;
  const MovedGoals goals(plan, limits);
  const std::weak_ptr<const LivePlan> first = plan_to(goals, elsewhere);
  EXPECT_FALSE(first.expired());
  for (const double x : {60.0, 70.0}) plan_to(goals, {x, 160.0});
  EXPECT_TRUE(first.expired());
}

TEST(MovedGoals, AGoalThatDoesNotFitIsRefusedWithTheReason) {
  const Plan plan = walled(GoalMission{home, {}});
  const MovedGoals goals(plan);
  for (const Vec2 goal_m : {Vec2{92.0, 106.0}, Vec2{-10.0, 100.0}}) {
    const auto answer = goals.plan_to(goal_m);
    ASSERT_TRUE(std::holds_alternative<MissionRefusal>(answer));
    EXPECT_NE(std::get<MissionRefusal>(answer).message.find("goal that fits is ["),
              std::string::npos);
  }
  EXPECT_TRUE(std::holds_alternative<MissionRefusal>(goals.plan_to({1e300, 0.0})));
}

std::string refusal(const MovedGoals& goals) {
  try {
    static_cast<void>(goals.plan_to(elsewhere));
  } catch (const BadQuestion& wrong) {
    return wrong.what();
  }
  return "accepted";
}

TEST(MovedGoals, OfPathsLargePlansAndUnknownOptionsAreNotOffered) {
  const Plan path = walled(PathMission{{{0.0, 160.0}, {180.0, 160.0}}, false, 10.0, 0.5});
  EXPECT_NE(refusal(MovedGoals(path)).find("follows a path"), std::string::npos);
  Plan plan = walled(GoalMission{home, {}});
  ReplanLimits small;
  small.most_cells = plan.grid.size() - 1;
  EXPECT_NE(refusal(MovedGoals(plan, small)).find("up to 2999"), std::string::npos);
  small.most_cells = plan.grid.size();
  EXPECT_EQ(refusal(MovedGoals(plan, small)), "accepted");
  plan.record.options_json.clear();
  EXPECT_NE(refusal(MovedGoals(plan)).find("names no options"), std::string::npos);
}

TEST(MovedGoals, ManyAskersOfOneGoalShareOnePlan) {
  const Plan plan = walled(GoalMission{home, {}});
  const MovedGoals goals(plan);
  std::vector<std::shared_ptr<const LivePlan>> found(8);
  std::vector<std::thread> askers;
  for (auto& one : found) askers.emplace_back([&] { one = plan_to(goals, elsewhere); });
  for (std::thread& asker : askers) asker.join();
  for (const auto& one : found) EXPECT_EQ(one, found[0]);
}

TEST(MovedGoals, WhileAProofIsMadeOthersMustTryAgain) {
  const Plan plan = walled(GoalMission{home, {}});
  ReplanLimits limits;
  limits.patience = std::chrono::milliseconds(1);
  const MovedGoals goals(plan, limits);
  const auto live = plan_to(goals, elsewhere);
  std::atomic<bool> done = false;
  std::thread prover([&] {
    while (!done) {
      try {
        static_cast<void>(goals.proof_of(*live));
        done = true;
      } catch (const NotNow&) {  // a plan was being made
      }
    }
  });
  bool refused = false;
  for (int k = 0; !refused && !done; ++k) {
    try {
      static_cast<void>(goals.plan_to({60.0 + 0.001 * k, 160.0}));
    } catch (const NotNow&) {
      refused = true;
    }
  }
  prover.join();
  EXPECT_TRUE(refused);
  EXPECT_EQ(plan_to(goals, elsewhere), plan_to(goals, elsewhere));
}

TEST(MovedGoals, AShortProofIsOfTheMovedPlanAlone) {
  const Plan plan = walled(GoalMission{home, {}});
  const MovedGoals goals(plan);
  const auto live = plan_to(goals, elsewhere);
  const auto proof = goals.proof_of(*live);
  EXPECT_EQ(proof, live->proof());
  EXPECT_EQ(goals.proof_of(*live), proof);
  const runtime::Certificate asked = proof->asked();
  Random random = Random::stream(7, 1);
  int decided = 0;
  for (int k = 0; k < 300; ++k) {
    const State s{{random.uniform(-20.0, 219.0), random.uniform(10.0, 209.0)},
                  Heading::from_rad(random.uniform(-3.1, 3.1))};
    const auto answer = asked.query(s.position_m.x, s.position_m.y, s.heading.rad());
    if (answer.verdict == Verdict::undecided) continue;
    ++decided;
    EXPECT_STREQ(name_of(answer.verdict), name_of(live->flights.fly(s, 0).outcome));
  }
  EXPECT_GT(decided, 200);
}

}  // namespace
}  // namespace fairway
