// Path missions of scenarios: circles, and which field they get.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>

#include "fairway/base/error.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/plan_map.hpp"
#include "fairway/run/plan_record.hpp"
#include "fairway/run/replan.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/start_states.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway {
namespace {

Scenario scenario_with(const std::string& mission) {
  return scenario_of_text(
      "map = { file = \"m\", cell_m = 5 }\n"
      "vehicle = { speed_mps = 10, turn_radius_m = 20 }\n"
      "[mission]\nkind = \"path\"\n" +
          mission,
      "s.toml");
}

std::string refusal(const std::string& mission) {
  try {
    (void)scenario_with(mission);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

ObstacleMap open_ground() {
  ObstacleMap map;
  map.grid = {100, 100, 0.0, 0.0, 5.0};
  map.obstacle.assign(map.grid.size(), 0);
  return map;
}

const std::string circle = "loiter = { center_m = [250, 250], radius_m = 60 }\n";

TEST(Loiter, IsAClosedPathAboutItsCentreEitherWay) {
  for (const bool left : {true, false}) {
    const Scenario scenario = scenario_with(
        left ? circle
             : "loiter = { center_m = [250, 250], radius_m = 60, direction = \"right\" }\n");
    const auto path = std::get<PathMission>(mission_on_map(scenario, open_ground()));
    EXPECT_TRUE(path.closed);
    const PathLocator locator(path);
    EXPECT_NEAR(locator.length_m(), two_pi * 60.0, 0.1);
    EXPECT_NEAR(locator.frame({250.0, 250.0}).offset_m, left ? 60.0 : -60.0, 0.05);
  }
}

TEST(Loiter, IsFlownRoundAndRoundTheWayItTurns) {
  for (const std::string side : {"left", "right"}) {
    for (const double radius_m : {20.0, 25.0, 60.0}) {
      const Scenario scenario =
          scenario_with("loiter = { center_m = [250, 250], radius_m = " + std::to_string(radius_m) +
                        ", direction = \"" + side + "\" }\n");
      const Mission mission = mission_on_map(scenario, open_ground());
      const Plan plan =
          std::get<Plan>(plan_map(open_ground(), scenario.vehicle, mission, scenario.plan));
      const ExactFlights flights(plan);
      for (const State& start : random_states(plan, StartRegion::safe_start, 200, 5)) {
        const Vec2 from = start.position_m - Vec2{250.0, 250.0};
        if (norm(from) > 180.0) continue;  // nearer to the edge a flight may leave the map
        const Flight flight = flights.follow(start, 3000.0);
        ASSERT_EQ(flight.onward.after, After::follow)
            << side << " " << radius_m << " from " << from.x << " " << from.y << " "
            << start.heading.rad() << " " << name_of(flight.result.outcome);
        const State end = end_of(flight);
        const Vec2 out = end.position_m - Vec2{250.0, 250.0};
        EXPECT_NEAR(norm(out), radius_m, 10.0) << side << " " << radius_m;
        const double turning = cross(out, end.heading.unit());
        EXPECT_GT(side == "left" ? turning : -turning, 0.0) << side << " " << radius_m;
      }
    }
  }
}

TEST(Loiter, ThatIsTighterThanTheVehicleOrNotWholeIsRefusedAtItsLine) {
  EXPECT_EQ(refusal("loiter = { center_m = [250, 250], radius_m = 19.5 }\n"),
            "s.toml:5: mission.loiter.radius_m: is 19.5, expected at least vehicle.turn_radius_m = "
            "20");
  EXPECT_NE(refusal("loiter = { radius_m = 30 }\n").find("mission.loiter.center_m is missing"),
            std::string::npos);
  EXPECT_NE(refusal("loiter = { center_m = [1, 2] }\n").find("mission.loiter.radius_m is missing"),
            std::string::npos);
  EXPECT_NE(refusal("path_file = \"p.csv\"\n" + circle).find("expected only one of them"),
            std::string::npos);
  EXPECT_NE(refusal("closed = true\n" + circle).find("expected only one of them"),
            std::string::npos);
  EXPECT_NE(refusal("").find("or a circle, mission.loiter"), std::string::npos);
}

TEST(PathFieldOfAPlan, IsInTheRecordsOfPathsAlone) {
  const ObstacleMap map = open_ground();
  const PathMission path{{{100.0, 250.0}, {400.0, 250.0}}, false};
  EXPECT_NE(plan_record(map, path, {}).options_json.find("\"path_field\":\"follow\""),
            std::string::npos);
  EXPECT_EQ(plan_record(map, GoalMission{{250.0, 250.0}, {}}, {}).options_json.find("path_field"),
            std::string::npos);
}

TEST(PathFieldOfAPlan, IsThePapersWhereARecordDoesNotNameIt) {
  PlanRecord record;
  record.options_json = R"({"plan": {"alpha": 2.0}})";
  EXPECT_EQ(field_options_of(record, "plan").path_field, PathField::paper);
  record.options_json = R"({"plan": {"path_field": "follow"}})";
  EXPECT_EQ(field_options_of(record, "plan").path_field, PathField::follow);
}

}  // namespace
}  // namespace fairway
