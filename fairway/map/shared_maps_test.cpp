// Reads every real map, fence and path in the folder next to the project, and compares its cells
// with facts known about the file.

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/map/read_path.hpp"

namespace fairway {
namespace {

using ::testing::HasSubstr;

class SharedMaps : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(FAIRWAY_SHARED_MAPS))
      GTEST_SKIP() << "no folder of shared maps next to the project";
  }

  static std::filesystem::path shared(const std::string& name) {
    return std::filesystem::path(FAIRWAY_SHARED_MAPS) / name;
  }

  static std::vector<std::filesystem::path> files(const std::string& ending) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(FAIRWAY_SHARED_MAPS))
      if (entry.path().filename().string().ends_with(ending)) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }

  static double share_of_obstacles(const ObstacleMap& map) {
    return static_cast<double>(std::count(map.obstacle.begin(), map.obstacle.end(), 1)) /
           static_cast<double>(map.obstacle.size());
  }
};

TEST_F(SharedMaps, EveryRosMapIsRead) {
  const auto maps = files(".yaml");
  EXPECT_GE(maps.size(), 25U);
  for (const auto& file : maps) {
    MapRequest request;
    request.file = file;
    request.cell_m = 0.25;
    request.footprint_radius_m = 0.1;
    const ObstacleMap map = read_map(request);
    EXPECT_EQ(map.obstacle.size(), map.grid.size()) << file;
    EXPECT_EQ(map.inputs.size(), 2U) << file;
    EXPECT_LT(share_of_obstacles(map), 1.0) << file;
    EXPECT_GT(share_of_obstacles(map), 0.0) << file;
  }
}

TEST_F(SharedMaps, CellsOfPixelSizeHaveTheSharesOfPixelsStatedForTheFiles) {
  const auto share = [](const std::string& name, double cell_m, bool unknown) {
    MapRequest request;
    request.file = shared(name);
    request.cell_m = cell_m;
    request.unknown_is_obstacle = unknown;
    request.outside_is_obstacle = false;
    return share_of_obstacles(read_map(request));
  };
  EXPECT_NEAR(share("ros_tuw_cave/map.yaml", 0.032, false), 0.035, 5e-4);
  EXPECT_NEAR(share("ros_tuw_cave/map.yaml", 0.032, true), 0.035 + 0.214, 1e-3);
  EXPECT_NEAR(share("ros_cob_campus/map.yaml", 0.25, false), 0.007, 1e-3);
  EXPECT_NEAR(share("ros_nav2/100by100_10.yaml", 0.05, true), 0.103, 5e-4) << "negate: 1";
  EXPECT_NEAR(share("ros_nav2/depot_keepout.yaml", 0.05, true), 0.168, 1e-3);
  EXPECT_NEAR(share("f1tenth_gym/berlin.yaml", 0.05, true), 0.700, 1e-3);
}

TEST_F(SharedMaps, AThresholdThatFreesTheUnknownIsWarnedAbout) {
  MapRequest request;
  request.file = shared("ros_nav2/depot.yaml");
  request.cell_m = 0.5;
  EXPECT_THAT(read_map(request).warnings, ::testing::Contains(HasSubstr("grey 205")));
  request.file = shared("ros_mit_racecar/basement_fixed.map.yaml");
  EXPECT_THAT(read_map(request).warnings, ::testing::Contains(HasSubstr("rotated by 3.14 rad")));
}

TEST_F(SharedMaps, EveryMovingAiMapIsReadAndItsScenariosEndsAreFree) {
  const auto maps = files(".map");
  EXPECT_GE(maps.size(), 13U);
  for (const auto& file : maps) {
    MapRequest request;
    request.file = file;
    request.cell_m = 2.0;
    request.resolution_m = 2.0;
    request.outside_is_obstacle = false;
    const ObstacleMap map = read_map(request);
    std::ifstream scenario(file.string() + ".scen");
    std::string line;
    std::getline(scenario, line);  // version
    int tasks = 0;
    while (std::getline(scenario, line)) {
      std::istringstream fields(line);
      std::string bucket, name;
      int width = 0, height = 0, x0 = 0, y0 = 0, x1 = 0, y1 = 0;
      if (!(fields >> bucket >> name >> width >> height >> x0 >> y0 >> x1 >> y1)) continue;
      ASSERT_EQ(width, map.grid.nx) << file;
      ASSERT_EQ(height, map.grid.ny) << file;
      // Scenario rows count from the top.
      EXPECT_EQ(map.obstacle[map.grid.index({x0, height - 1 - y0})], 0) << file << " " << line;
      EXPECT_EQ(map.obstacle[map.grid.index({x1, height - 1 - y1})], 0) << file << " " << line;
      ++tasks;
    }
    EXPECT_GT(tasks, 100) << file;
  }
}

TEST_F(SharedMaps, EveryRaceTracksLinesLieOnItsFreeCells) {
  int lines = 0;
  for (const auto& file : files("_map.yaml")) {
    MapRequest request;
    request.file = file;
    std::ifstream yaml(file);  // cells of pixel size: larger ones may touch a wall next to the line
    for (std::string key; yaml >> key;)
      if (key == "resolution:") yaml >> request.cell_m;
    const ObstacleMap map = read_map(request);
    const std::string stem = file.string().substr(0, file.string().size() - 9);
    for (const char* kind : {"_centerline.csv", "_raceline.csv"}) {
      const auto path = read_path(stem + kind, map, true);
      EXPECT_GT(path.size(), 800U) << stem << kind;
      int blocked = 0;
      for (const Vec2 p : path) blocked += map.obstacle[map.grid.index(map.grid.cell_of(p))];
      EXPECT_EQ(blocked, 0) << stem << kind;
      ++lines;
    }
  }
  EXPECT_EQ(lines, 16);
}

TEST_F(SharedMaps, EveryTrackOfLargeRacesIsRead) {
  ObstacleMap world;
  world.grid = {400, 400, -2000.0, -2000.0, 10.0};
  for (const char* name : {"Austin", "BrandsHatch", "Budapest", "Montreal", "SaoPaulo"})
    EXPECT_GT(read_path(shared(std::string("tum_racetracks/") + name + ".csv"), world).size(), 400U)
        << name;
}

TEST_F(SharedMaps, EveryFenceAndMissionIsRead) {
  for (const char* name :
       {"CMAC-circuit.txt", "CMAC-fence.txt", "Dalby-OBC2016-fence.txt", "Dalby-OBC2016.txt",
        "ce_geofence_home_base.plan", "multicopter_mission_geofence_avoid.plan",
        "qgroundcontrol_sample.plan", "qgroundcontrol_sample_with_survey.plan"}) {
    MapRequest request;
    request.file = shared(std::string("uav_plans/") + name);
    request.cell_m = 2.0;
    const ObstacleMap map = read_map(request);
    EXPECT_LT(share_of_obstacles(map), 0.95) << name;
    ASSERT_TRUE(map.frame.geo.has_value()) << name;
    EXPECT_LT(map.frame.geo->worst_error_m, 0.02) << name;
  }
}

TEST_F(SharedMaps, AMissionInsideItsFenceIsAPathOnFreeCells) {
  MapRequest request;
  request.file = shared("uav_plans/multicopter_mission_geofence_avoid.plan");
  request.cell_m = 2.0;
  const ObstacleMap map = read_map(request);
  const auto path = read_path(request.file, map);
  ASSERT_EQ(path.size(), 4U);
  for (const Vec2 p : path) EXPECT_EQ(map.obstacle[map.grid.index(map.grid.cell_of(p))], 0);
  // Two maps of one airfield: the fence's own map includes the circuit flown inside it.
  request.file = shared("uav_plans/CMAC-fence.txt");
  const ObstacleMap cmac = read_map(request);
  const auto circuit = read_path(shared("uav_plans/CMAC-circuit.txt"), cmac);
  ASSERT_EQ(circuit.size(), 5U) << "the last two waypoints are the same place";
  for (const Vec2 p : circuit) EXPECT_EQ(cmac.obstacle[cmac.grid.index(cmac.grid.cell_of(p))], 0);
}

TEST_F(SharedMaps, BuildingsAndTheHeightRasterOverThemAgree) {
  MapRequest request;
  request.file = shared("geo_buildings_alexandria/buildings.geojson");
  request.cell_m = 2.0;
  const ObstacleMap buildings = read_map(request);
  EXPECT_NEAR(share_of_obstacles(buildings), 0.2, 0.05);
  request.altitude_m = 4.0;
  request.file = shared("geo_buildings_alexandria/hag.tif");
  const ObstacleMap heights = read_map(request);
  // Trees are high, too, so only one direction: the outline of a large building is high ground.
  const auto roof = std::filesystem::temp_directory_path() / "fairway-shared-maps-roof.csv";
  std::ofstream(roof) << "lon,lat\n-77.051400,38.812100\n-77.051300,38.811700\n";
  const auto on_heights = read_path(roof, heights);
  const auto on_buildings = read_path(roof, buildings);
  std::filesystem::remove(roof);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(buildings.obstacle[buildings.grid.index(buildings.grid.cell_of(on_buildings[i]))], 1);
    EXPECT_EQ(heights.obstacle[heights.grid.index(heights.grid.cell_of(on_heights[i]))], 1);
  }
}

TEST_F(SharedMaps, TerrainIsCutAtTheFlightAltitude) {
  MapRequest request;
  request.file = shared("geo_terrain_davos/davosdorf.tif");
  request.cell_m = 10.0;
  request.outside_is_obstacle = false;
  double previous = 1.1;
  for (const double altitude_m : {1500.0, 1800.0, 2200.0, 2844.0}) {
    request.altitude_m = altitude_m;
    const ObstacleMap map = read_map(request);
    EXPECT_EQ(map.grid, (Grid{559, 495, 779503.0, 185530.0, 10.0}));
    const double share = share_of_obstacles(map);
    EXPECT_LT(share, previous);
    previous = share;
  }
  EXPECT_EQ(previous, 0.0) << "nothing is higher than 2843.1 m";
}

}  // namespace
}  // namespace fairway
