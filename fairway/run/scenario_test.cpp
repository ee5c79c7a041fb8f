#include "fairway/run/scenario.hpp"

#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/map/testing/scratch_folder.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/product_file.hpp"
#include "fairway/run/scenario_keys.hpp"

namespace fairway {
namespace {

const std::string whole = R"([map]
file = "maps/campus.yaml"
cell_m = 4
unknown = "free"
[vehicle]
speed_mps = 10.0
turn_radius_m = 20.0
[mission]
kind = "goal"
goal_m = [120.0, 340.0]
goal_heading_rad = 1.57
[plan]
metric = "octile"
[simulate]
states = [[10.0, 20, 0.0], [1, 2, 3]]
seed = 7
)";

/// `whole` with the first `from` replaced.
std::string with(const std::string& from, const std::string& to) {
  std::string text = whole;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
  try {
    (void)scenario_of_text(text, "dir/s.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Scenarios, SayWhatIsToBeReachedByAWordARectangleOrAFile) {
  const auto region = [](const std::string& value) {
    return scenario_of_text(whole + "[verify]\nregion = " + value + "\n", "dir/s.toml")
        .verify.region;
  };
  using Kind = RegionOfInterest::Kind;
  EXPECT_EQ(scenario_of_text(whole, "dir/s.toml").verify.region.kind, Kind::goal);
  EXPECT_EQ(region("\"obstacle\"").kind, Kind::obstacle);
  EXPECT_EQ(region("[1, -2, 3.5, 4]").rectangle_m, (std::array{1.0, -2.0, 3.5, 4.0}));
  EXPECT_EQ(region("\"area.geojson\"").kind, Kind::cells);
  EXPECT_EQ(region("\"area.geojson\"").file, "dir/area.geojson");
  for (const char* wrong : {"[1, 2, 3]", "[3, 0, 1, 4]", "7", "\"\"", "\"1,2,3,4\""}) {
    const std::string said = refusal(whole + "[verify]\nregion = " + wrong + "\n");
    EXPECT_TRUE(said.starts_with("dir/s.toml:18: verify.region: expected")) << said;
  }
}

TEST(Scenarios, HaveBorderSamplesInFoursAndForBitmapsAlone) {
  const std::string bitmap = whole + "[verify]\nmethod = \"bitmap\"\nborder_samples = ";
  EXPECT_EQ(refusal(bitmap + "40\n"), "accepted");
  EXPECT_EQ(refusal(bitmap + "42\n"),
            "dir/s.toml:19: verify.border_samples: is 42, expected a multiple of four");
  EXPECT_EQ(refusal(whole + "[verify]\nborder_samples = 40\n"),
            "dir/s.toml:18: verify.border_samples: belongs to verify.method = \"bitmap\"");
}

TEST(Scenarios, GiveWhatTheySayAndDefaultsForTheRest) {
  const Scenario s = scenario_of_text(whole, "dir/s.toml");
  EXPECT_EQ(s.map.file, "dir/maps/campus.yaml");
  EXPECT_EQ(s.map.cell_m, 4.0);
  EXPECT_FALSE(s.map.unknown_is_obstacle);
  EXPECT_TRUE(s.map.outside_is_obstacle);
  EXPECT_EQ(s.vehicle, (Vehicle{10.0, 20.0}));
  EXPECT_EQ(s.mission.goal_m, (Vec2{120.0, 340.0}));
  EXPECT_EQ(s.mission.goal_heading_rad, 1.57);
  EXPECT_EQ(s.plan.metric, Metric::octile);
  EXPECT_EQ(s.plan.alpha, FieldOptions{}.alpha);
  EXPECT_EQ(s.plan.sigma_cells, FieldOptions{}.sigma_cells);
  ASSERT_EQ(s.simulate.states.size(), 2U);
  EXPECT_EQ(s.simulate.states[1], (State{{1, 2}, Heading::from_rad(3)}));
  EXPECT_EQ(s.simulate.seed, 7U);
  EXPECT_EQ(s.place_of("mission.goal_m"), "dir/s.toml:10");
  EXPECT_EQ(s.place_of("plan.alpha"), "dir/s.toml");
}

TEST(Scenarios, AbsolutePathsStayAndPathMissionsNameTheirFile) {
  const Scenario s = scenario_of_text(R"(
    map = { file = "/m.map", cell_m = 1, resolution_m = 2 }
    vehicle = { speed_mps = 1, turn_radius_m = 2 }
    mission = { kind = "path", path_file = "line.csv", closed = true }
  )",
                                      "dir/s.toml");
  EXPECT_EQ(s.map.file, "/m.map");
  EXPECT_EQ(s.mission.path_file, "dir/line.csv");
  EXPECT_TRUE(s.mission.closed);
}

/// `.a` so many times.
std::string dotted(int parts) {
  std::string text;
  for (int i = 0; i < parts; ++i) text += ".a";
  return text;
}

TEST(Scenarios, DotsInStringsCommentsAndNumbersAreNoParts) {
  const std::string dots(100, '.');
  EXPECT_EQ(refusal(whole + "# don't " + dots + "\n"), "accepted");
  std::string states = "states = [";
  for (int i = 0; i < 100; ++i) states += "[1.5, 2.5, 0.5], ";
  EXPECT_EQ(refusal(with("states = [[10.0, 20, 0.0], [1, 2, 3]]", states + "]")), "accepted");
  const std::string message = refusal(with("seed = 7", "seed = \"\"\"\n" + dots + "\"\"\""));
  EXPECT_TRUE(message.find("simulate.seed: expected a whole number") != std::string::npos)
      << message;
}

TEST(Scenarios, RefusalsNameLineKeyAndWhatIsExpected) {
  const struct {
    std::string text;
    const char* message;
  } cases[] = {
      {with("cell_m = 4", "cell_m = -4"),
       "dir/s.toml:3: map.cell_m: expected a number in (0, 1000000000], found -4"},
      {with("cell_m = 4", "cell_m = nan"), "dir/s.toml:3: map.cell_m: expected a number in"},
      {with("cell_m = 4", "cell_m = inf"), "dir/s.toml:3: map.cell_m: expected a number in"},
      {with("cell_m = 4", "cell_m = \"4\""), "dir/s.toml:3: map.cell_m: expected a number, found"},
      {with("cell_m = 4", "cell_m = 20"),
       "dir/s.toml:7: vehicle.turn_radius_m: is 20 m, expected more than map.cell_m, which is 20 "
       "m"},
      {with("cell_m = 4", "cell = 4"),
       "dir/s.toml:3: map.cell: there is no such key; did you mean map.cell_m?"},
      {with("metric", "alhpa"),
       "dir/s.toml:13: plan.alhpa: there is no such key; did you mean plan.alpha?"},
      {with("[plan]\nmetric", "[map2]\nmetric"),
       "dir/s.toml:12: map2: there is no such key; did you mean map?"},
      {with("seed = 7", "sigma_cells = 7"),
       "dir/s.toml:16: simulate.sigma_cells: there is no such key; did you mean plan.sigma_cells?"},
      {with("seed = 7", "zzzzzzzzzz = 7"),
       "dir/s.toml:16: simulate.zzzzzzzzzz: there is no such key"},
      {with("seed = 7", "seed = -1"), "dir/s.toml:16: simulate.seed: expected a whole number"},
      {with("seed = 7", "seed = 1.5"), "dir/s.toml:16: simulate.seed: expected a whole number"},
      {with("\"octile\"", "\"manhattan\""),
       "dir/s.toml:13: plan.metric: expected \"euclidean\", \"octile\" or \"paper\", found"},
      {with("[120.0, 340.0]", "[120.0]"),
       "dir/s.toml:10: mission.goal_m: expected an array of two numbers, found"},
      {with("[120.0, 340.0]", "[120.0, nan]"), "dir/s.toml:10: mission.goal_m: expected a number"},
      {with("[1, 2, 3]", "[1, 2]"),
       "dir/s.toml:15: simulate.states: expected an array of arrays of 3 numbers, found"},
      {with("[1, 2, 3]", "[1, 2, 90]"),
       "dir/s.toml:15: simulate.states: expected headings in radians from -7 to 7 (not 90; 90 "
       "degrees "
       "are 1.5708), found"},
      {with("[1, 2, 3]", "[1, 2, -1e3]"),
       "dir/s.toml:15: simulate.states: expected headings in radians from -7 to 7 (not -1000), "
       "found"},
      {with("seed = 7", "states_deg = [[8.5, 47.3, 0.0], [97.3, 8.5, 0.0]]"),
       "dir/s.toml:16: simulate.states_deg: expected [latitude, longitude, course] with"},
      {with("seed = 7", "states_deg = [[47.3, 8.5, 361.0]]"),
       "dir/s.toml:16: simulate.states_deg: expected a number in [-360, 360]"},
      {with("[[10.0, 20, 0.0], [1, 2, 3]]", "3"),
       "dir/s.toml:15: simulate.states: expected an array"},
      {with("goal_m = [120.0, 340.0]\n", ""), "dir/s.toml: mission.goal_m is missing"},
      {with("kind = \"goal\"\n", ""), "dir/s.toml: mission.kind is missing, expected \"goal\" or"},
      {with("file = \"maps/campus.yaml\"\n", ""), "dir/s.toml: map.file is missing"},
      {with("maps/campus.yaml", ""), "dir/s.toml:2: map.file: expected the name of a file"},
      {with("kind = \"goal\"", "kind = \"path\""), "dir/s.toml: mission.path_file is missing"},
      {with("goal_heading_rad = 1.57", "path_file = \"x\""),
       "dir/s.toml:11: mission.path_file: belongs to missions of kind \"path\""},
      {with("goal_heading_rad = 1.57", "goal_deg = [1, 2]"),
       "dir/s.toml:11: mission.goal_deg: is given in addition to mission.goal_m"},
      {with("goal_m = [120.0, 340.0]", "goal_deg = [91, 2]"),
       "dir/s.toml:10: mission.goal_deg: expected"},
      {with("goal_m = [120.0, 340.0]", "goal_m = [120.0, 340.0"), "dir/s.toml:11: is not TOML: "},
      {with("seed = 7", "seed = 7\nseed = 8"), "dir/s.toml:17: is not TOML: "},
      {with("seed = 7", "seed = 7\n[a" + dotted(50000) + "]"),
       "dir/s.toml:17: has a key of more than 32 parts"},
      {with("seed = 7", "a" + dotted(33) + " = 1"),
       "dir/s.toml:16: has a key of more than 32 parts"},
      {with("seed = 7", "x = {\"a.b\"" + dotted(40) + " = 1}"),
       "dir/s.toml:16: has a key of more than 32 parts"},
      {"map = 3\n" + whole.substr(whole.find("[vehicle]")),
       "dir/s.toml:1: map: expected a table, [map]"},
      {"", "dir/s.toml: map.file is missing"},
  };
  for (const auto& c : cases) {
    const std::string message = refusal(c.text);
    EXPECT_TRUE(message.starts_with(c.message))
        << "expected " << c.message << "\nfound " << message;
  }
}

TEST(Scenarios, DamagedTextIsRefusedOrReadNeverWorse) {
  Random random(3);
  int accepted = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text = whole;
    const auto changes = 1 + random.below(4);
    for (std::uint64_t i = 0; i < changes; ++i) {
      text[random.below(text.size())] = static_cast<char>(random.below(256));
    }
    accepted += refusal(text) == "accepted";
  }
  EXPECT_LT(accepted, 3000);
}

TEST(ScenarioKeys, EffectiveValuesReadBackGiveTheSameScenario) {
  const Scenario s = scenario_of_text(whole, "dir/s.toml");
  const auto plan = effective_values(s, "plan");
  EXPECT_EQ(plan["metric"], "octile");
  EXPECT_TRUE(plan["alpha"].is_null()) << "open until the map is known";
  const std::array papers{ScenarioOverride{"plan.preset", "paper"}};
  EXPECT_EQ(effective_values(scenario_of_text(whole, "dir/s.toml", papers), "plan")["alpha"],
            FieldOptions{}.alpha);
  EXPECT_EQ(effective_values(s, "map")["unknown"], "free");
  EXPECT_TRUE(effective_values(s, "map")["inclusion"].is_null());
}

TEST(ScenarioKeys, StandInTheTableOnce) {
  std::set<std::string> names;
  for (const ScenarioKey& key : scenario_keys())
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
}

TEST(ScenarioKeys, TheDocumentationHoldsTheTable) {
  std::ifstream in(FAIRWAY_SOURCE_DIR "/docs/scenario.md");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(text.find(scenario_keys_markdown()), std::string::npos)
      << "docs/scenario.md should hold the output of `fairway --scenario-keys`:\n"
      << scenario_keys_markdown();
}

TEST(Scenario, IsReadTheSameWhateverItsMarkAndLineEnds) {
  for (const char* mark : {"", "\xef\xbb\xbf"}) {
    for (const char* end : {"\n", "\r\n", "\r"}) {
      std::string text = mark;
      for (const char c : whole) text += c == '\n' ? end : std::string(1, c);
      const Scenario scenario = scenario_of_text(text, "s.toml");
      EXPECT_EQ(scenario.place_of("simulate.seed"), "s.toml:16");
      EXPECT_EQ(scenario.simulate.states.size(), 2U);
    }
  }
}

TEST(Scenario, AnotherKindOfFileIsToldByName) {
  const ScratchFolder folder;
  const auto error = [&](const std::string& name, std::string_view text) {
    const std::filesystem::path file = folder.write(name, text);
    return input_error_of([&] { (void)read_scenario(file); });
  };
  EXPECT_EQ(error("campus.yaml", "image: a.pgm\nresolution: 0.05\n"),
            "campus.yaml: is a ROS map: name it in a scenario, as map.file");
  EXPECT_EQ(error("a.plan", "{\"fileType\": \"Plan\"}"),
            "a.plan: is a QGroundControl plan: name it in a scenario, as map.file");
  EXPECT_EQ(error("p.safetensors", safetensors_header({{{"fairway", "{\"cell_m\":1}"}}, {}})),
            "p.safetensors: is a plan, expected a scenario: use it with `fairway simulate`");
  EXPECT_NE(error("s.toml", "[map\n").find("s.toml:1: is not TOML"), std::string::npos);
  const std::filesystem::path scenario = folder.write("s.toml", whole);
  EXPECT_EQ(input_error_of([&] { (void)read_plan(scenario); }),
            "s.toml: is a scenario: `fairway plan` makes a plan from it");
  EXPECT_EQ(input_error_of([&] { (void)read_certificate(scenario); }),
            "s.toml: is a scenario: `fairway plan` makes a plan from it");
  EXPECT_EQ(input_error_of([&] { (void)product_kind(scenario); }),
            "s.toml: is a scenario: `fairway plan` makes a plan from it");
  EXPECT_EQ(input_error_of([&] { (void)read_certificate(folder.file("p.safetensors")); }),
            "p.safetensors: is a plan: `fairway verify` makes its certificate");
}

TEST(Scenario, TheMapFilesKindsAreThoseThatAreRead) {
  for (const char* kind : {"ROS", "MovingAI", "GeoJSON", "QGroundControl", "ArduPilot",
                           "QGC waypoints", "GeoTIFF", "PGM"})
    EXPECT_NE(map_kinds_text().find(kind), std::string::npos) << kind;
  EXPECT_NE(scenario_keys_markdown().find("| required | " + map_kinds_text() + " |"),
            std::string::npos);
}

}  // namespace
}  // namespace fairway
