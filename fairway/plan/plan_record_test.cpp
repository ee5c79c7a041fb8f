#include "fairway/plan/plan_record.hpp"

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/plan/plan_record_json.hpp"

namespace fairway {
namespace {

PlanRecord read(const std::string& text) {
  return plan_record_of(parse_strict_json(text, "p"), "p: fairway");
}

std::string complaint(const std::string& text) {
  try {
    (void)read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

PlanRecord whole(Mission mission) {
  Frame frame{{1.5, -2.0, 0.25}, GeoReference{47.4, 8.55, 0.001}, "PROJCS[\"x\"]"};
  return {"fairway 1",
          std::move(mission),
          frame,
          std::vector<InputFile>{{"a.yaml", "00ff"}},
          R"({"plan":{"alpha":2.5}})",
          R"({"of_others":[1,{"b":2}]})"};
}

TEST(PlanRecord, GivesBackWhatWasWritten) {
  for (const Mission& mission :
       {Mission(GoalMission{{60.0, 50.0}, {}}), Mission(GoalMission{{60.0, 50.0}, 4.0}),
        Mission(PathMission{{{1.0, 2.0}, {3.0, 4.0}, {0.1, 7.0}}, true, 5.0, 0.25})}) {
    const PlanRecord record = whole(mission);
    const PlanRecord back = read(json_text(record));
    EXPECT_EQ(back.program, record.program);
    EXPECT_EQ(back.mission, record.mission);
    EXPECT_EQ(back.frame, record.frame);
    ASSERT_TRUE(back.inputs);
    EXPECT_EQ(back.inputs->front().path, "a.yaml");
    EXPECT_EQ(back.options_json, record.options_json);
    EXPECT_EQ(back.more_json, record.more_json);
    EXPECT_EQ(json_text(back), json_text(record));
  }
}

TEST(PlanRecord, AMemberThatIsAbsentStaysAbsent) {
  for (const char* text :
       {"{}", R"({"inputs":[]})", R"({"mine":1})",
        R"({"frame":{"georeference":null,"projected_crs":null,"world_from_grid":)"
        R"({"x_m":0.0,"y_m":0.0,"yaw_rad":0.0}}})"}) {
    EXPECT_EQ(json_text(read(text)), text);
  }
  EXPECT_FALSE(read("{}").mission);
  EXPECT_FALSE(read(R"({"frame":null,"mission":null})").frame);
  EXPECT_EQ(frame_in(read("{}")), Frame{});
}

TEST(PlanRecord, HoldsAContractOnlyIfThereIsOne) {
  PlanRecord record = whole(GoalMission{{60.0, 50.0}, {}});
  EXPECT_EQ(json_text(record).find("contract"), std::string::npos);
  record.contract = VehicleContract::of({10.0, 20.0});
  record.contract->command_error_m = 6.0;
  const PlanRecord back = read(json_text(record));
  EXPECT_EQ(back.contract, record.contract);
  EXPECT_EQ(back.more_json, record.more_json);
  EXPECT_EQ(json_text(back), json_text(record));
}

TEST(PlanRecord, NamesWhatIsDamaged) {
  const auto expect = [](const char* text, const char* where) {
    EXPECT_NE(complaint(text).find(where), std::string::npos) << complaint(text);
  };
  expect(R"({"mission":{"kind":"race"}})", "p: fairway.mission.kind");
  expect(R"({"mission":{"kind":"goal","goal_m":[20.0]}})", "mission.goal_m");
  expect(R"({"mission":{"kind":"goal"}})", "goal_m");
  expect(R"({"mission":{"kind":"goal","goal_m":[1,2],"goal_heading_rad":"east"}})",
         "goal_heading_rad");
  expect(R"({"mission":{"kind":"path","vertices_m":[[1,2],[3,4]],"closed":1}})", "mission.closed");
  expect(
      R"({"mission":{"kind":"path","vertices_m":[[1,2],[3,4]],"closed":true,"delta_position_m":1,"delta_heading_rad":1,"accept":"follow"}})",
      "mission.accept");
  expect(R"({"frame":3})", "p: fairway.frame");
  expect(R"({"frame":{"georeference":{"latitude_deg":1}}})", "longitude_deg");
  expect(R"({"frame":{"projected_crs":7}})", "projected_crs");
  expect(R"({"inputs":[{"path":"a"}]})", "sha256");
  expect(R"({"options":[]})", "p: fairway.options");
  expect(R"({"program":1})", "p: fairway.program");
  expect(R"({"contract":1})", "p: fairway.contract: expected a JSON object");
  expect(R"({"contract":{"wind_mps":1}})", "p: fairway.contract");
  expect(R"({"contract":{"rho":1}})", "p: fairway.contract: has the unknown key \"rho\"");
}

}  // namespace
}  // namespace fairway
