#include "fairway/run/new_scenario.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/map/testing/scratch_folder.hpp"
#include "fairway/run/map_survey.hpp"
#include "fairway/run/run.hpp"

namespace fairway {
namespace {

/// A plain room of 60 by 40 pixels with a wall that has a door.
std::string moving_ai_room() {
  std::string text = "type octile\nheight 40\nwidth 60\nmap\n";
  for (int row = 0; row < 40; ++row) {
    for (int x = 0; x < 60; ++x) {
      const bool rim = row == 0 || row == 39 || x == 0 || x == 59;
      const bool wall = x == 25 && (row < 12 || row > 27);
      text += rim || wall ? '@' : '.';
    }
    text += '\n';
  }
  return text;
}

std::string pgm_room() {
  std::string text = "P2\n60 40\n255\n";
  for (int i = 0; i < 60 * 40; ++i) text += i % 60 == 20 && i / 60 < 20 ? "0 " : "254 ";
  return text;
}

/// A map of each kind that is text.
std::vector<MapRequest> maps_in(const ScratchFolder& folder) {
  std::vector<MapRequest> maps;
  const auto add = [&](const std::string& name, const std::string& text) -> MapRequest& {
    (void)folder.write(name, text);
    MapRequest request;
    request.file = folder.file(name);
    return maps.emplace_back(request);
  };
  add("room.map", moving_ai_room()).resolution_m = 2.0;
  add("image.pgm", pgm_room()).resolution_m = 0.5;
  add("ros.yaml",
      "image: image.pgm\nresolution: 0.05\norigin: [-1.0, -2.0, 0.0]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  add("fence.fence",
      "47.3990 8.5470\n47.3970 8.5440\n47.4010 8.5440\n47.4010 8.5500\n"
      "47.3970 8.5500\n47.3970 8.5440\n");
  add("fence.geojson",
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":
      {"inclusion":true},"geometry":{"type":"Polygon","coordinates":[[[8.54,47.39],[8.55,47.39],
      [8.55,47.4],[8.54,47.4],[8.54,47.39]]]}}]})");
  add("out.plan", R"({"fileType":"Plan","geoFence":{"version":2,"polygons":[],
    "circles":[{"inclusion":false,"circle":{"center":[47.3977,8.5456],"radius":40}}]}})");
  return maps;
}

TEST(NewScenario, OfEveryKindOfMapCanBePlannedAsItIs) {
  const ScratchFolder folder;
  for (const MapRequest& map : maps_in(folder)) {
    const std::string output = folder.file("new.toml");
    const NewScenario made = new_scenario({map, output, {}, {}, {}});
    EXPECT_GT(made.serves, 0.5) << map.file;
    std::ofstream(output) << made.text;
    const Scenario read = read_scenario(output);
    const Progress silent;
    StageClock clock(silent);
    const auto answer = plan_scenario(read, clock);
    ASSERT_TRUE(std::holds_alternative<Planned>(answer)) << map.file;
    const Planned& planned = std::get<Planned>(answer);
    EXPECT_EQ(read.mission.goal_deg.has_value(), planned.map.frame.is_on_earth()) << made.text;
    EXPECT_GE(std::max(planned.map.grid.nx, planned.map.grid.ny), 40) << map.file;
    EXPECT_LE(std::max(planned.map.grid.nx, planned.map.grid.ny), 1000) << map.file;
    for (std::size_t at = 0; at < made.text.size();) {  // no line is too long to read
      const std::size_t end = made.text.find('\n', at);
      EXPECT_LE(end - at, 120U);
      at = end + 1;
    }
  }
}

TEST(NewScenario, KeepsToTheVehicleThatIsGiven) {
  const ScratchFolder folder;
  const MapRequest map = maps_in(folder).front();
  const NewScenario made = new_scenario({map, folder.file("n.toml"), 1.0, 4.5, 7.25});
  EXPECT_EQ(made.scenario.map.cell_m, 1.0);
  EXPECT_EQ(made.scenario.vehicle.turn_radius_m, 4.5);
  EXPECT_EQ(made.scenario.vehicle.speed_mps, 7.25);
  EXPECT_EQ(new_scenario({map, folder.file("n.toml"), {}, 4.5, {}}).scenario.vehicle.turn_radius_m,
            4.5);
}

TEST(NewScenario, WhereNoGoalFitsSaysWhatWould) {
  const ScratchFolder folder;
  const MapRequest map = maps_in(folder).front();
  const std::string refused = input_error_of([&] {
    (void)new_scenario({map, folder.file("n.toml"), {}, 60.0, {}});
  });
  EXPECT_NE(refused.find("turn_radius_m = "), std::string::npos) << refused;
  EXPECT_NE(input_error_of([&] {
              (void)new_scenario({map, folder.file("n.toml"), 5.0, 4.0, {}});
            }),
            "");
}

TEST(MapSurvey, CountsWhatIsFreeAndConnected) {
  const ScratchFolder folder;
  (void)folder.write("two.map",
                     "type octile\nheight 5\nwidth 9\nmap\n@@@@@@@@@\n@..@....@\n@..@....@\n"
                     "@..@....@\n@@@@@@@@@\n");
  MapRequest request;
  request.file = folder.file("two.map");
  request.resolution_m = 1.0;
  request.outside_is_obstacle = false;
  const MapSurvey s = survey_map(request, {});
  EXPECT_EQ(s.free_cells, 18U);
  EXPECT_EQ(s.part_cells, (std::vector<std::size_t>{12, 6}));
  EXPECT_EQ(s.clearance_m, 2.0);
  EXPECT_EQ(*s.widest_place_m, (Vec2{5.5, 2.5}));
  EXPECT_NE(survey_words(s, "two").find("2: 66 %, 33 % of the free cells"), std::string::npos)
      << survey_words(s, "two");
  EXPECT_EQ(survey_json(s)["widest_place_deg"], nullptr);
  EXPECT_EQ(survey_map(request, 1.2).free_cells, 0U);  // a buffer of 2.4 m
}

TEST(SensibleCells, AreOneTwoOrFiveTimesAPowerOfTenAndAsManyAsAskedFor) {
  const ScratchFolder folder;
  for (MapRequest map : maps_in(folder)) {
    map.cell_m = sensible_cell_m(map, 200);
    const Grid grid = read_map(map).grid;
    EXPECT_LE(std::max(grid.nx, grid.ny), 205) << map.file;
    EXPECT_GE(std::max(grid.nx, grid.ny), 75) << map.file;
    const double digit = map.cell_m / std::pow(10.0, std::floor(std::log10(map.cell_m) + 1e-9));
    EXPECT_TRUE(std::abs(digit - 1) < 1e-9 || std::abs(digit - 2) < 1e-9 ||
                std::abs(digit - 5) < 1e-9)
        << map.cell_m;
  }
}

}  // namespace
}  // namespace fairway
