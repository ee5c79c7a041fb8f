#include "fairway/run/final_legs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/run/plan_record.hpp"
#include "fairway/steer/dubins_words.hpp"

namespace fairway {
namespace {

Plan open_plan() {
  Plan plan;
  plan.grid = {30, 24, -5.0, 3.0, 4.0};
  plan.vehicle = {8.0, 9.0};
  plan.heading_rad.assign(plan.grid.size(), 0.0F);
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  return plan;
}

/// A flight that is in a goal cell when it starts.
Flight reached_at(const State& entry) {
  Flight flight;
  flight.start = entry;
  flight.result = {Outcome::reach, 0.0, 0.0};
  return flight;
}

State random_state(Random& random, const Grid& grid) {
  return {{grid.x0_m + random.unit() * grid.width_m(), grid.y0_m + random.unit() * grid.height_m()},
          Heading::from_rad(random.uniform(-pi, pi))};
}

bool touches(const Plan& plan, const std::vector<FlightSegment>& segments) {
  for (const FlightSegment& piece : segments) {
    for (int i = 0; i <= 200; ++i) {
      const Cell cell = plan.grid.cell_of(state_at(piece, piece.length_m * i / 200).position_m);
      if (!plan.grid.contains(cell)) return true;
      if (plan.region[plan.grid.index(cell)] == Region::obstacle) return true;
    }
  }
  return false;
}

TEST(FinalLegs, EndAtTheGoalsPoseAndTouchNoObstacle) {
  Random random(7);
  FinalLegTally tally;
  for (int i = 0; i < 1500; ++i) {
    Plan plan = open_plan();
    for (Region& region : plan.region) {
      if (random.unit() < 0.03) region = Region::obstacle;
      if (random.unit() < 0.03) region = Region::buffer;
    }
    const State goal = random_state(random, plan.grid);
    Flight flight = reached_at(random_state(random, plan.grid));
    flight.result.time_s = 3.0;
    FinalLegTally one;
    flight.final_leg = FinalLegs(plan, goal).leg_of(flight);
    one.add(flight, goal);
    tally.add(flight, goal);
    EXPECT_FALSE(touches(plan, flight.final_leg.segments)) << i;
    const double shortest_m = shortest_length_m(flight.start, goal, 9.0);
    double time_s = 3.0;
    State at = flight.start;
    for (const FlightSegment& piece : flight.final_leg.segments) {
      EXPECT_NEAR(piece.time_s, time_s, 1e-9);
      EXPECT_LE(norm(piece.start.position_m - at.position_m), 1e-9);
      EXPECT_LE(std::abs(piece.curvature_per_m), 1.0 / 9.0);
      time_s += piece.length_m / 8.0;
      at = state_at(piece, piece.length_m);
    }
    switch (flight.final_leg.state) {
      case FinalLegState::not_asked:
        FAIL() << "a flight that reaches has a state";
      case FinalLegState::none_clear:
        EXPECT_TRUE(flight.final_leg.segments.empty());
        EXPECT_EQ(one.first_refused->entry, flight.start);
        break;
      case FinalLegState::shortest:
        EXPECT_NEAR(flight.final_leg.length_m, shortest_m, 1e-9);
        EXPECT_LE(norm(at.position_m - goal.position_m), 1e-9);
        break;
      case FinalLegState::other:
        EXPECT_GE(flight.final_leg.length_m, shortest_m - 1e-9);
        EXPECT_LE(norm(at.position_m - goal.position_m), 1e-9);
        break;
    }
  }
  EXPECT_EQ(tally.count, 1500U);
  EXPECT_GT(tally.shortest, 100U);
  EXPECT_GT(tally.other, 50U);
  EXPECT_GT(tally.none_clear, 100U);
  EXPECT_EQ(tally.count, tally.shortest + tally.other + tally.none_clear);
  EXPECT_LE(tally.worst_end_error_m, 1e-9);
  EXPECT_LE(tally.worst_end_error_rad, 1e-11);
}

TEST(FinalLegs, AWalledGoalHasNoneAndTheSummarySaysSo) {
  Plan plan = open_plan();
  const State goal{{60.0, 50.0}, Heading::from_rad(1.0)};
  const Cell middle = plan.grid.cell_of(goal.position_m);
  for (int d = -1; d <= 1; ++d) {
    for (const Cell cell : {Cell{middle.ix + d, middle.iy - 1}, Cell{middle.ix + d, middle.iy + 1},
                            Cell{middle.ix - 1, middle.iy + d}, Cell{middle.ix + 1, middle.iy + d}})
      plan.region[plan.grid.index(cell)] = Region::obstacle;
  }
  Flight flight = reached_at({{20.0, 20.0}, Heading()});
  flight.final_leg = FinalLegs(plan, goal).leg_of(flight);
  EXPECT_EQ(flight.final_leg.state, FinalLegState::none_clear);
  FinalLegTally tally;
  tally.add(flight, goal);
  const auto json = final_legs_json(tally);
  EXPECT_EQ(json["count"], 1);
  EXPECT_EQ(json["none_clear"], 1);
  EXPECT_EQ(json["first_none_clear"]["entry"], (nlohmann::json{20.0, 20.0, 0.0}));
  EXPECT_NE(final_legs_words(tally).find("For 1, none of the approaches"), std::string::npos);
}

TEST(FinalLegs, AreForFlightsThatReachAndGoalsWithAHeading) {
  const Plan plan = open_plan();
  Flight flight = reached_at({{20.0, 20.0}, Heading()});
  flight.result.outcome = Outcome::leave;
  EXPECT_EQ(FinalLegs(plan, {{60.0, 50.0}, Heading()}).leg_of(flight).state,
            FinalLegState::not_asked);
  EXPECT_TRUE(final_legs_json({}).is_null());
  EXPECT_EQ(final_legs_words({}), "");
}

TEST(GoalPose, IsThatOfAGoalWithAHeading) {
  Plan plan = open_plan();
  EXPECT_FALSE(goal_pose_of(plan).has_value());
  plan.record.mission = GoalMission{{20.0, 30.0}, {}};
  EXPECT_FALSE(goal_pose_of(plan).has_value());
  plan.record.mission = GoalMission{{20.0, 30.0}, 4.0};
  EXPECT_EQ(goal_pose_of(plan), (State{{20.0, 30.0}, Heading::from_rad(4.0)}));
  plan.record.mission = PathMission{{{1.0, 2.0}, {3.0, 4.0}}, false, 1.0, 0.1};
  EXPECT_FALSE(goal_pose_of(plan).has_value());
}

}  // namespace
}  // namespace fairway
