#include "fairway/run/findings.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fairway/run/plan_warnings.hpp"
#include "fairway/run/verification_summary.hpp"

namespace fairway {
namespace {

using testing::HasSubstr;

/// Free cells in a row, of which the last `cut_off` have no command, and the goal.
Plan row_of_cells(int free, int cut_off) {
  Plan plan;
  plan.grid = {free + 1, 1, 0.0, 0.0, 1.0};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.region.back() = Region::goal;
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  plan.heading_rad.assign(plan.grid.size(), 0.0F);
  for (int i = free - cut_off; i < free; ++i) {
    plan.cost_m[static_cast<std::size_t>(i)] = std::numeric_limits<float>::infinity();
  }
  return plan;
}

/// Shares in the order undecided, reach, collide, leave, trapped.
Verification verification(const std::array<double, verdict_count>& all) {
  Verification v;
  v.outcome.volume.all = all;
  v.outcome.volume.usable = {0.0, 0.95, 0.05, 0.0, 0.0};
  v.outcome.volume.commanded = {0.0, 0.99, 0.01, 0.0, 0.0};
  v.outcome.volume.samples = 1'000'000;
  return v;
}

ScenarioFlights flights(const std::vector<Outcome>& given, std::size_t reach, std::size_t collide) {
  ScenarioFlights flown;
  flown.given = given.size();
  for (const Outcome outcome : given) flown.results.push_back({outcome, 1.0, 1.0});
  flown.results.insert(flown.results.end(), reach, {Outcome::reach, 1.0, 1.0});
  flown.results.insert(flown.results.end(), collide, {Outcome::collide, 1.0, 1.0});
  return flown;
}

TEST(Findings, AreOfWhatTheMissionCanUseWhereMuchIsCutOff) {
  const auto found =
      findings(row_of_cells(1083, 1050), verification({0.00257, 0.0866, 0.91083, 0.0, 0.0}));
  EXPECT_EQ(findings_table(found),
            "95.0 %  of states that the mission can use  are proved to reach the goal\n"
            "97.0 %  of free cells                       are cut off from the goal, without a "
            "command (1,050 of 1,083)\n"
            " 5.0 %  of states that the mission can use  are proved to collide\n"
            "99.0 %  of safe starts with a command       are proved to reach the goal\n");
}

TEST(Findings, BeginWithTheShareOfAllStatesAndGoOnWithWhatStandsInTheWay) {
  const auto found =
      findings(row_of_cells(1083, 100), verification({0.00257, 0.0866, 0.91083, 0.0, 0.0}));
  EXPECT_EQ(findings_table(found),
            " 8.7 %  of all states                  are proved to reach the goal\n"
            " 9.2 %  of free cells                  are cut off from the goal, without a command "
            "(100 of 1,083)\n"
            "91.1 %  of all states                  are proved to collide\n"
            " 0.3 %  of all states                  are undecided\n"
            "99.0 %  of safe starts with a command  are proved to reach the goal\n");
}

TEST(Findings, HaveNoLineForWhatThereIsNothingOf) {
  const auto found = findings(row_of_cells(10, 0), verification({0.0, 1.0, 0.0, 0.0, 0.0}));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].share, "100 %");
  EXPECT_EQ(found[0].of, "all states");
  EXPECT_EQ(found[1].of, "safe starts with a command");
}

TEST(Findings, ShowNoMoreDigitsThanTheSampleBears) {
  Verification v = verification({0.0, 0.9163, 0.0837, 0.0, 0.0});
  v.outcome.volume.samples = 1000;
  EXPECT_EQ(findings(row_of_cells(10, 0), v)[0].share, "92 %");
}

TEST(Findings, SayWhatEndedTheProof) {
  Verification v = verification({0.2, 0.8, 0.0, 0.0, 0.0});
  v.outcome.stopped_by = StoppedBy::time_limit;
  v.options.time_limit_s = 20.0;
  const auto found = findings(row_of_cells(10, 0), v);
  EXPECT_EQ(found[2].share, "");
  EXPECT_EQ(found[2].what,
            "the proof stopped at the time limit of 20 s: 20.0 % undecided (requested: at most "
            "0.5 %)");
}

TEST(Findings, OfAnotherRegionAreNotAboutTheGoal) {
  Verification v = verification({0.0, 1.0, 0.0, 0.0, 0.0});
  v.certificate.region_of_interest.kind = RegionOfInterest::Kind::obstacle;
  const std::string table = findings_table(findings(row_of_cells(10, 5), v));
  EXPECT_THAT(table, HasSubstr("reach the region"));
  EXPECT_THAT(table, testing::Not(HasSubstr("cut off")));
}

TEST(Findings, OfFlightsSayWhereTheyStart) {
  const auto found =
      findings(row_of_cells(10, 0), flights({Outcome::reach, Outcome::collide}, 9934, 66));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].share, "99.3 %");
  EXPECT_EQ(found[0].of, "safe starts with a command");
  EXPECT_EQ(found[0].what, "reach in 10,000 random flights (99.1 % to 99.5 %); 66 collide");
  EXPECT_EQ(found[1].share, "1");
  EXPECT_EQ(found[1].of, "2 given starts");
  EXPECT_EQ(found[1].what, "reaches the goal: 1 collides");
  EXPECT_TRUE(findings(row_of_cells(10, 0), flights({}, 0, 0)).empty());
}

TEST(Findings, AreThreeTextsEachInTheSummary) {
  EXPECT_EQ(findings_json({{"1 %", "cells", "are odd"}}),
            nlohmann::json::parse(R"([{"share": "1 %", "of": "cells", "what": "are odd"}])"));
}

TEST(LimitWarning, ComesWhenTimeOrMemoryEndedTheProof) {
  Verification v = verification({0.2, 0.8, 0.0, 0.0, 0.0});
  v.options.time_limit_s = 20.0;
  v.options.memory_limit_bytes = 500'000'000;
  const auto warning = [&](StoppedBy reason) {
    v.outcome.stopped_by = reason;
    return limit_warning(v).value_or("");
  };
  EXPECT_THAT(warning(StoppedBy::time_limit),
              HasSubstr("The proof stopped at the time limit of 20 s"));
  EXPECT_THAT(warning(StoppedBy::memory_limit),
              HasSubstr("The proof stopped at the memory limit of 500 MB"));
  EXPECT_EQ(warning(StoppedBy::undecided_max), "");
  EXPECT_EQ(warning(StoppedBy::stalled), "");
}

TEST(FailingWarning, ComesWhenMoreThanOneFlightInTwentyFails) {
  Plan plan = row_of_cells(10, 0);
  EXPECT_FALSE(failing_warning(plan, {{0, 0, 0, 0, 0}}));
  EXPECT_FALSE(failing_warning(plan, {{0, 95, 5, 0, 0}}));
  const auto warning = failing_warning(plan, {{0, 9052, 1, 0, 947}});
  ASSERT_TRUE(warning);
  EXPECT_THAT(*warning, HasSubstr("9.5 % of 10,000 random flights from safe starts with a command "
                                  "do not reach the goal (1 collides, 947 get trapped)"));
  EXPECT_THAT(*warning, testing::Not(HasSubstr("alpha")));
  plan.record.options_json = R"({"plan": {"alpha": 0.9}})";
  EXPECT_THAT(*failing_warning(plan, {{0, 90, 10, 0, 0}}), HasSubstr("plan.alpha is 0.9"));
}

}  // namespace
}  // namespace fairway
