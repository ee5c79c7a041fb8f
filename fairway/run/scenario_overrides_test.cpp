// Values from the command line in place of the file's.
#include "fairway/run/scenario_overrides.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/scenario_keys.hpp"

namespace fairway {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string file = R"([map]
file = "maps/campus.yaml"
cell_m = 4
[vehicle]
speed_mps = 10.0
turn_radius_m = 20.0
[mission]
kind = "goal"
goal_m = [120.0, 340.0]
[simulate]
states = [[10.0, 20, 0.0], [1, 2, 3]]
)";

Scenario with(const std::vector<std::string>& texts) {
  std::vector<ScenarioOverride> overrides;
  for (const std::string& text : texts) overrides.push_back(override_of_text(text));
  return scenario_of_text(file, "dir/s.toml", overrides);
}

std::string refusal(const std::vector<std::string>& texts) {
  try {
    (void)with(texts);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Overrides, ReadLikeTheSameLinesInTheFile) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"cell_m = 4", "cell_m = 2.5"},
      {"speed_mps = 10.0", "speed_mps = 1e1"},
      {"goal_m = [120.0, 340.0]", "goal_m = [ 1, -2.5 ]"},
      {"states = [[10.0, 20, 0.0], [1, 2, 3]]", "states = [[7, 8, 0.9]]"},
      {"file = \"maps/campus.yaml\"", "file = \"other.yaml\""}};
  const std::vector<std::string> tables{"map", "vehicle", "mission", "simulate", "map"};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& [from, to] = cases[i];
    std::string text = file;
    text.replace(text.find(from), from.size(), to);
    const Scenario expected = scenario_of_text(text, "dir/s.toml");
    const Scenario got = with({tables[i] + "." + to});
    for (const ScenarioKey& key : scenario_keys()) {
      EXPECT_EQ(key.shown(got), key.shown(expected)) << key.name << " with " << to;
    }
  }
}

TEST(Overrides, KeepTheDigestOfTheFileAndSayWhatGaveAKey) {
  const Scenario plain = scenario_of_text(file, "dir/s.toml");
  const Scenario set = with({"plan.alpha=1.5"});
  EXPECT_EQ(set.sha256, plain.sha256);
  EXPECT_EQ(set.place_of("plan.alpha"), "--set");
  EXPECT_EQ(set.place_of("map.cell_m"), "dir/s.toml:3");
  EXPECT_EQ(map_request(with({"map.cell_m=2"})).place_of("map.cell_m"), "--set");
  nlohmann::json summary;
  add_overrides(summary, plain);
  EXPECT_TRUE(summary.is_null());
  add_overrides(summary, set);
  EXPECT_EQ(summary, (nlohmann::json{{"set", {{"plan.alpha", 1.5}}}}));
}

TEST(Overrides, TheLaterOfTwoForOneKeyCounts) {
  EXPECT_EQ(with({"map.cell_m=3", "map.cell_m=2"}).map.cell_m, 2.0);
}

TEST(Overrides, GiveWhatTheFileLacks) {
  std::string text = file;
  text.replace(text.find("goal_m = [120.0, 340.0]\n"), 24, "");
  const ScenarioOverride goal = override_of_text("mission.goal_m=[1,2]");
  const Scenario scenario = scenario_of_text(text, "s.toml", std::span(&goal, 1));
  EXPECT_EQ(scenario.mission.goal_m->y, 2.0);
}

TEST(Overrides, TextsMayGoWithoutQuotes) {
  EXPECT_EQ(with({"plan.metric=paper"}).plan.metric, Metric::paper);
  EXPECT_EQ(with({"plan.metric=\"paper\""}).plan.metric, Metric::paper);
  EXPECT_EQ(with({"map.file=a b#1=2.yaml"}).map.file, "dir/a b#1=2.yaml");
  EXPECT_EQ(with({"map.file='1.yaml'"}).map.file, "dir/1.yaml");
}

TEST(Overrides, ErrorsNameTheOption) {
  EXPECT_EQ(refusal({"map.cell_m=-8"}),
            "--set: map.cell_m: expected a number in (0, 1000000000], found -8");
  EXPECT_EQ(refusal({"map.cell_m=abc"}), "--set: map.cell_m: expected a number, found 'abc'");
  EXPECT_EQ(refusal({"map.cel_m=8"}),
            "--set: map.cel_m: there is no such key; did you mean map.cell_m?");
  EXPECT_EQ(refusal({"cell_m=8"}), "--set: cell_m: there is no such key; did you mean map.cell_m?");
  EXPECT_THAT(refusal({"mission.goal_m=[1, 2"}),
              StartsWith("--set: mission.goal_m: [1, 2 is not TOML"));
  EXPECT_THAT(refusal({"map.file=\"a"}), StartsWith("--set: map.file: \"a is not TOML"));
  EXPECT_THAT(refusal({"map.file=a\n[plan]"}), HasSubstr("control character"));
  EXPECT_THAT(refusal({"mission.path_file=a.csv"}),
              StartsWith("--set: mission.path_file: belongs"));
  EXPECT_EQ(refusal({"vehicle.turn_radius_m=3"}),
            "--set: vehicle.turn_radius_m: is 3 m, expected more than map.cell_m, which is 4 m");
  for (const char* text : {"", "map.cell_m", "map.cell_m=", "=4", " = "}) {
    EXPECT_EQ(refusal({text}), "expected KEY=VALUE, such as map.cell_m=4.0") << text;
  }
}

}  // namespace
}  // namespace fairway
