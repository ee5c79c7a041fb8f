#include "fairway/run/mission_on_map.hpp"

#include <string>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/map/tangent_plane.hpp"
#include "fairway/run/plan_record.hpp"

namespace fairway {
namespace {

Scenario scenario_with(const std::string& goal) {
  return scenario_of_text(
      "map = { file = \"m\", cell_m = 1 }\n"
      "vehicle = { speed_mps = 1, turn_radius_m = 2 }\n"
      "[mission]\nkind = \"goal\"\n" +
          goal,
      "s.toml");
}

ObstacleMap map_of(bool in_degrees) {
  ObstacleMap map;
  map.grid = {200, 100, -100.0, -50.0, 1.0};
  map.obstacle.assign(map.grid.size(), 0);
  if (in_degrees) map.geo = GeoReference{47.3977, 8.5456, 0.0};
  return map;
}

std::string refusal(const std::string& goal, bool in_degrees) {
  try {
    (void)mission_on_map(scenario_with(goal), map_of(in_degrees));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MissionOnMap, AGoalInDegreesLiesWhereItsMetresSay) {
  const TangentPlane plane({47.3977, 8.5456});
  const GeodeticPoint point = plane.from_plane({30.0, -20.0});
  const auto goal = "goal_deg = [" + std::to_string(point.latitude_deg) + ", " +
                    std::to_string(point.longitude_deg) + "]";
  const Mission mission = mission_on_map(scenario_with(goal), map_of(true));
  const Vec2 goal_m = std::get<GoalMission>(mission).goal_m;
  EXPECT_NEAR(goal_m.x, 30.0, 0.2);  // six decimals of a degree
  EXPECT_NEAR(goal_m.y, -20.0, 0.2);
  const auto lon_lat = lon_lat_of(map_of(true).geo)({30.0, -20.0});
  EXPECT_DOUBLE_EQ(lon_lat.latitude_deg, point.latitude_deg);
  EXPECT_DOUBLE_EQ(lon_lat.longitude_deg, point.longitude_deg);
}

TEST(MissionOnMap, GoalsThatCannotBeOnTheMapAreRefusedAtTheirLine) {
  EXPECT_TRUE(refusal("goal_m = [500, 0]", false)
                  .starts_with("s.toml:5: mission.goal_m: the goal (500, 0) is outside the map, "
                               "expected x in [-100, 100] and y in [-50, 50]"));
  EXPECT_NE(refusal("goal_m = [8.5, 47.4]", true), "");
  EXPECT_NE(refusal("goal_m = [147.4, 8.5]", true).find("mission.goal_deg = [lat"),
            std::string::npos);
  EXPECT_NE(refusal("goal_deg = [47.3977, 8.5456]", false).find("not in degrees"),
            std::string::npos);
  EXPECT_NE(refusal("goal_deg = [8.5456, 47.3977]", true).find("100 km"), std::string::npos);
  EXPECT_NE(refusal("goal_deg = [47.41, 8.5456]", true).find("outside the map"), std::string::npos);
}

TEST(MissionOnMap, BordersOfTheMapBelongToIt) {
  EXPECT_EQ(refusal("goal_m = [100, 50]", false), "accepted");
  EXPECT_EQ(refusal("goal_m = [-100, -50]", false), "accepted");
  EXPECT_NE(refusal("goal_m = [100.001, 50]", false), "accepted");
}

TEST(PlanRecord, GivesTheGeoreferenceBack) {
  const Scenario scenario = scenario_with("goal_m = [0, 0]");
  Plan plan;
  plan.record_json = plan_record(scenario, map_of(true), GoalMission{});
  const auto geo = georeference_of(plan, "p");
  ASSERT_TRUE(geo);
  EXPECT_EQ(geo->latitude_deg, 47.3977);
  plan.record_json = plan_record(scenario, map_of(false), GoalMission{});
  EXPECT_FALSE(georeference_of(plan, "p"));
  plan.record_json = "{}";
  EXPECT_FALSE(georeference_of(plan, "p"));
  plan.record_json = R"({"frame":{"georeference":{"latitude_deg":"north"}}})";
  EXPECT_THROW((void)georeference_of(plan, "p"), InputError);
}

}  // namespace
}  // namespace fairway
