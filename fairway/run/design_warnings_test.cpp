#include "fairway/run/design_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fairway {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Scenario scenario_with(const std::string& plan, double turn_radius_m = 20.0) {
  return scenario_of_text(
      "map = { file = \"m\", cell_m = 1 }\nvehicle = { speed_mps = 1, "
      "turn_radius_m = " +
          std::to_string(turn_radius_m) +
          " }\n[mission]\nkind = \"path\"\npath_file = \"p.csv\"\n[plan]\n" + plan,
      "s.toml");
}

const Mission goal = GoalMission{{0.0, 0.0}, {}};
const Mission line = PathMission{{{0.0, 0.0}, {300.0, 0.0}}, false};

TEST(DesignWarnings, DefaultsAndTheRangesOfThePaperPassInSilence) {
  for (const Mission& mission : {goal, line}) {
    EXPECT_THAT(design_warnings(scenario_with(""), mission), IsEmpty());
    EXPECT_THAT(design_warnings(scenario_with("alpha = 2\nbeta = 3\nsigma_border = 1\n"
                                              "sigma_path = 2"),
                                mission),
                IsEmpty());
    EXPECT_THAT(design_warnings(scenario_with("sigma_border = 0\nsigma_path = 0"), mission),
                IsEmpty());
  }
}

TEST(DesignWarnings, WhatIsSetOutsideTheRangesOfThePaperIsToldAtItsLine) {
  const Scenario scenario =
      scenario_with("alpha = 0.5\nbeta = 1.5\nsigma_border = 0.5\nsigma_path = 2.5");
  const std::string alpha =
      "s.toml:7: plan.alpha: is 0.5; the paper asks for at least 2: below that, there may be no "
      "room for a full turn between an obstacle and the nearest free cells";
  const std::string border = "s.toml:9: plan.sigma_border: is 0.5; the paper asks for 1 to 2";
  EXPECT_THAT(design_warnings(scenario, goal),
              ElementsAre(alpha,
                          "s.toml:8: plan.beta: is 1.5; the paper asks for at least 2: flights "
                          "may circle around a smaller goal",
                          border));
  EXPECT_THAT(
      design_warnings(scenario, line),
      ElementsAre(alpha, border, "s.toml:10: plan.sigma_path: is 2.5; the paper asks for 1 to 2"));
}

TEST(DesignWarnings, WhatTheVehicleCannotFlyOfAPathIsToldAtThePathsLine) {
  const Mission eight = PathMission{{{0.0, 0.0}, {300.0, 300.0}, {300.0, 0.0}, {0.0, 300.0}}, true};
  EXPECT_THAT(design_warnings(scenario_with(""), eight),
              ElementsAre(testing::StartsWith("s.toml:5: mission.path_file: the path meets itself "
                                              "at (150, 150)")));
  EXPECT_THAT(design_warnings(scenario_with("", 400.0), line),
              ElementsAre(testing::HasSubstr("fits into a circle of radius 150 m")));
}

}  // namespace
}  // namespace fairway
