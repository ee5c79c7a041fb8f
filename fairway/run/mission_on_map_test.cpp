#include "fairway/run/mission_on_map.hpp"

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/map/tangent_plane.hpp"
#include "fairway/map/testing/scratch_folder.hpp"
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
  if (in_degrees) map.frame.geo = GeoReference{47.3977, 8.5456, 0.0};
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
  const auto lon_lat = lon_lat_of(map_of(true).frame, "map")({30.0, -20.0});
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
  EXPECT_NE(refusal("goal_deg = [47.3977, 8.5456]", false).find("not georeferenced"),
            std::string::npos);
  EXPECT_NE(refusal("goal_deg = [8.5456, 47.3977]", true).find("100 km"), std::string::npos);
  EXPECT_NE(refusal("goal_deg = [47.41, 8.5456]", true).find("outside the map"), std::string::npos);
}

TEST(MissionOnMap, BordersOfTheMapBelongToIt) {
  EXPECT_EQ(refusal("goal_m = [100, 50]", false), "accepted");
  EXPECT_EQ(refusal("goal_m = [-100, -50]", false), "accepted");
  EXPECT_NE(refusal("goal_m = [100.001, 50]", false), "accepted");
}

// A mission of two waypoints without a fence, and a goal or path through them: on the border of
// everything that the file names.
Scenario scenario_without_fence(const ScratchFolder& folder, Metric metric, double radius_m) {
  (void)folder.write("two.plan", R"({"fileType":"Plan","mission":{"items":[
    {"type":"SimpleItem","command":16,"frame":3,"params":[0,0,0,null,47.3977,8.5456,50]},
    {"type":"SimpleItem","command":16,"frame":3,"params":[0,0,0,null,47.3990,8.5460,50]}]}})");
  Scenario scenario = scenario_of_text(
      "map = { file = \"two.plan\", cell_m = 7 }\n"
      "vehicle = { speed_mps = 20, turn_radius_m = " +
          std::to_string(radius_m) +
          " }\n"
          "[mission]\nkind = \"goal\"\ngoal_deg = [47.3990, 8.5460]\n",
      folder.file("s.toml"));
  scenario.plan.metric = metric;
  return scenario;
}

TEST(MapRequest, AMissionWithoutAFenceHasRoomHoweverWideTheVehicleTurns) {
  const ScratchFolder folder;
  for (const Metric metric : {Metric::euclidean, Metric::paper}) {
    for (const double radius_m : {8.0, 37.0, 150.3}) {
      Scenario scenario = scenario_without_fence(folder, metric, radius_m);
      const auto refused = [&] {
        const ObstacleMap map = read_map(map_request(scenario));
        const auto answer =
            compute_field(map, scenario.vehicle, mission_on_map(scenario, map), scenario.plan);
        const auto* refusal = std::get_if<MissionRefusal>(&answer);
        return refusal == nullptr ? std::string() : refusal->message;
      };
      EXPECT_EQ(refused(), "") << radius_m;
      scenario.mission.kind = MissionKind::path;
      scenario.mission.path_file = scenario.map.file;
      EXPECT_EQ(refused(), "") << radius_m;
      scenario.map.world_margin_m = 1.5 * radius_m;  // the user's word counts
      EXPECT_NE(refused(), "") << radius_m;
    }
  }
}

// One keep-out fence and nothing else: the scenario says what else the world is.
TEST(MapRequest, AKeepOutFenceAloneLeavesRoomForTheScenariosMission) {
  const ScratchFolder folder;
  (void)folder.write("out.plan", R"({"fileType":"Plan","geoFence":{"version":2,"polygons":[],
    "circles":[{"inclusion":false,"circle":{"center":[47.3977,8.5456],"radius":40}}]}})");
  (void)folder.write("line.csv", "x_m,y_m\n-300,900\n600,900\n");
  const auto refused = [&](const std::string& mission) -> std::string {
    const Scenario scenario = scenario_of_text(
        "map = { file = \"out.plan\", cell_m = 10 }\n"
        "vehicle = { speed_mps = 20, turn_radius_m = 25 }\n" +
            mission,
        folder.file("s.toml"));
    const ObstacleMap map = read_map(map_request(scenario));
    for (const State& s : scenario.simulate.states)
      EXPECT_TRUE(map.grid.contains(map.grid.cell_of(s.position_m)));
    const auto answer =
        compute_field(map, scenario.vehicle, mission_on_map(scenario, map), scenario.plan);
    const auto* refusal = std::get_if<MissionRefusal>(&answer);
    return refusal == nullptr ? std::string() : refusal->message;
  };
  EXPECT_EQ(refused("[mission]\nkind = \"goal\"\ngoal_deg = [47.4050, 8.5456]\n"), "");
  EXPECT_EQ(refused("[mission]\nkind = \"goal\"\ngoal_m = [0, -800]\n"
                    "[simulate]\nstates = [[900, 900, 0]]\n"),
            "");
  EXPECT_EQ(refused("[mission]\nkind = \"path\"\npath_file = \"line.csv\"\n"), "");
}

TEST(MapRequest, ErrorsOfTheMapAndThePathSayTheScenariosLine) {
  const ScratchFolder folder;
  const auto error = [&](const std::string& text, bool mission) {
    return input_error_of([&] {
      const Scenario scenario = scenario_of_text(text, folder.file("s.toml"));
      const ObstacleMap map = mission ? map_of(false) : read_map(map_request(scenario));
      (void)mission_on_map(scenario, map);
    });
  };
  const std::string rest =
      "\ncell_m = 1\n[vehicle]\nspeed_mps = 1\nturn_radius_m = 2\n[mission]\nkind = \"path\"\n"
      "path_file = \"gone.csv\"\n";
  EXPECT_EQ(error("[map]\nfile = \"gone.yaml\"" + rest, false),
            "gone.yaml: no such file (map.file of s.toml:2)");
  EXPECT_EQ(error("[map]\nfile = \"gone.yaml\"" + rest, true),
            "gone.csv: no such file (mission.path_file of s.toml:9)");
}

TEST(MissionOnMap, RefusalsBringTheWarningsOfTheMap) {
  ObstacleMap map = map_of(false);
  map.warnings = {"the origin is turned"};
  const Scenario scenario = scenario_with("goal_m = [500, 0]");
  const auto warnings_of = [&](const auto& act) -> std::vector<std::string> {
    try {
      act();
    } catch (const WarnedInputError& error) {
      return error.warnings;
    }
    return {};
  };
  EXPECT_EQ(warnings_of([&] { (void)mission_on_map(scenario, map); }), map.warnings);
  std::fill(map.obstacle.begin(), map.obstacle.end(), 1);
  const auto answer = compute_field(map, scenario.vehicle, GoalMission{{0, 0}, {}}, scenario.plan);
  const auto& refusal = std::get<MissionRefusal>(answer);
  EXPECT_NE(refusal.message.find("no cell of this map is free"), std::string::npos);
  EXPECT_EQ(warnings_of([&] { throw_refusal(scenario, map.frame, refusal); }), map.warnings);
}

TEST(PlanRecord, HoldsTheFrameOfTheMap) {
  const Scenario scenario = scenario_with("goal_m = [0, 0]");
  EXPECT_EQ(plan_record(scenario, map_of(true), GoalMission{}).frame, map_of(true).frame);
  EXPECT_EQ(plan_record(scenario, map_of(false), GoalMission{}).frame, Frame{});
}

}  // namespace
}  // namespace fairway
