#include "fairway/run/cell_size_warning.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "fairway/map/read_map.hpp"
#include "fairway/run/mission_on_map.hpp"

namespace fairway {
namespace {

/// Two rooms of 20 by 20 pixels, of a metre each, joined by a passage `gap` pixels wide, whose
/// lower wall is at an odd pixel.
Scenario scenario_of_rooms(int gap, double cell_m, double turn_radius_m) {
  const auto file = std::filesystem::path(testing::TempDir()) /
                    ("rooms_" + std::to_string(gap) + "_" + std::to_string(::getpid()) + ".map");
  std::ofstream out(file);
  out << "type octile\nheight 20\nwidth 60\nmap\n";
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 60; ++x) {
      const bool room = x < 20 || x >= 40;
      out << (room || (y >= 9 && y < 9 + gap) ? '.' : '@');
    }
    out << '\n';
  }
  Scenario scenario;
  scenario.map.file = file;
  scenario.map.cell_m = cell_m;
  scenario.map.resolution_m = 1.0;
  scenario.vehicle.turn_radius_m = turn_radius_m;
  scenario.mission.goal_m = Vec2{10.0, 10.0};
  return scenario;
}

std::optional<std::string> warning_for(const Scenario& scenario) {
  const ObstacleMap map = read_map(map_request(scenario));
  return cell_size_warning(scenario, map, GoalMission{{10.0, 10.0}, {}});
}

TEST(CellSizeWarning, TellsOfGroundThatFinerCellsOpen) {
  const auto warning = warning_for(scenario_of_rooms(2, 2.0, 3.0));
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->find("cells of 2 m are coarser than 0.4 turning radii; with cells of 1 m"),
            std::string::npos)
      << *warning;
}

TEST(CellSizeWarning, IsQuietWhereNothingOpensOrCellsAreFine) {
  EXPECT_FALSE(warning_for(scenario_of_rooms(8, 2.0, 3.0)));   // wide enough for both
  EXPECT_FALSE(warning_for(scenario_of_rooms(0, 2.0, 3.0)));   // closed for both
  EXPECT_FALSE(warning_for(scenario_of_rooms(2, 2.0, 10.0)));  // cells of 0.2 r
}

}  // namespace
}  // namespace fairway
