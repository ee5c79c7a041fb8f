#include "fairway/run/only_connected.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fairway/field/compute_field.hpp"
#include "fairway/field/testing/sample_maps.hpp"
#include "fairway/run/plan_record.hpp"
#include "fairway/run/scenario.hpp"

namespace fairway {
namespace {

using samples::Mask;

TEST(OnlyConnected, LeavesOutWhatTouchesAtACornerAtMost) {
  ObstacleMap map = samples::map_of(samples::drawn({"..#..",  //
                                                    ".#...",  //
                                                    "#....",  //
                                                    ".#..."}),
                                    1.0);
  keep_only_connected(map, GoalMission{{3.5, 1.5}, {}}, "m");
  EXPECT_EQ(map.obstacle, samples::drawn({"###..",  //
                                          "##...",  //
                                          "#....",  //
                                          "##..."})
                              .cells);
  ASSERT_EQ(map.warnings.size(), 1U);
  EXPECT_TRUE(
      map.warnings[0].starts_with("m: map.only_connected left out 4 of 16 free cells (25 %)"))
      << map.warnings[0];
}

TEST(OnlyConnected, KeepsEveryPartThatThePathMeets) {
  ObstacleMap map = samples::map_of(samples::drawn({"..#..#.."}), 1.0);
  keep_only_connected(map, PathMission{{{0.5, 0.5}, {4.5, 0.5}}}, "m");
  EXPECT_EQ(map.obstacle, samples::drawn({"..#..###"}).cells);
}

TEST(OnlyConnected, LeavesTheMapAsItIsWhereNothingIsToDo) {
  const ObstacleMap whole = samples::map_of(samples::drawn({"....", "..#."}), 1.0);
  for (const Vec2 goal : {Vec2{0.5, 0.5}, Vec2{2.5, 0.5}, Vec2{99.0, 0.5}}) {
    ObstacleMap map = whole;
    keep_only_connected(map, GoalMission{goal, {}}, "m");
    EXPECT_EQ(map.obstacle, whole.obstacle);
    EXPECT_TRUE(map.warnings.empty());
  }
}

// Where a plan has commands it is the same plan; a part cut off is no longer free ground.
TEST(OnlyConnected, ChangesNoCostAndNoRegionOfWhatIsJoined) {
  Random random(8);
  int left_out = 0;
  for (int draw = 0; draw < 200; ++draw) {
    Mask mask = samples::blobs(random, 50, 40, 10, 5.0);
    const int wall = 10 + static_cast<int>(random.below(30));
    for (int iy = 0; iy < 40; ++iy) mask.at(wall, iy) = 1;
    const ObstacleMap whole = samples::map_of(mask, 1.0);
    ObstacleMap map = whole;
    const GoalMission goal{{random.uniform(0.0, 50.0), random.uniform(0.0, 40.0)}, {}};
    keep_only_connected(map, goal, "m");
    const Vehicle vehicle{1.0, 1.5};
    const FieldOrRefusal before = compute_field(whole, vehicle, goal, {});
    const FieldOrRefusal after = compute_field(map, vehicle, goal, {});
    ASSERT_EQ(before.index(), after.index());
    const Field* field = std::get_if<Field>(&before);
    if (field == nullptr) continue;
    left_out += map.warnings.empty() ? 0 : 1;
    const Field& kept = std::get<Field>(after);
    for (std::size_t i = 0; i < map.obstacle.size(); ++i) {
      if (map.obstacle[i] != 0) continue;
      EXPECT_EQ(kept.region[i], field->region[i]);
      EXPECT_EQ(kept.cost_m[i], field->cost_m[i]);
    }
  }
  EXPECT_GT(left_out, 20);
}

TEST(OnlyConnected, IsRecordedWhereItIsAskedFor) {
  const std::string text =
      "[map]\nfile = \"m\"\ncell_m = 1\nonly_connected = {}\n[vehicle]\nspeed_mps = 1\n"
      "turn_radius_m = 2\n[mission]\nkind = \"goal\"\ngoal_m = [0, 0]\n";
  const auto record = [&](const std::string& value) {
    std::string one = text;
    one.replace(one.find("{}"), 2, value);
    return plan_record(scenario_of_text(one, "s.toml"), ObstacleMap{}, GoalMission{}).options_json;
  };
  EXPECT_NE(record("true").find("\"only_connected\":true"), std::string::npos);
  EXPECT_EQ(record("false").find("only_connected"), std::string::npos);
}

}  // namespace
}  // namespace fairway
