#include "fairway/tune/tune.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/map/testing/scratch_folder.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/edited_scenario.hpp"
#include "fairway/run/region_request.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/tune/search.hpp"
#include "fairway/tune/tuning_products.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string text = R"(# A yard.
[map]
file = "map.pgm"
resolution_m = 2.0
cell_m = 2.0  # as fine as the map
[vehicle]
speed_mps = 5.0
turn_radius_m = 5.0
[mission]
kind = "goal"
goal_m = [60.0, 60.0]
[plan]
alpha = 2.0  # wide
modes = 0
[verify]
undecided_max = 0.1
)";

/// A yard with some walls.
std::string yard() {
  constexpr int n = 50;
  std::string pixels(n * n, '\xff');
  const auto wall = [&](int x, int y, int w, int h) {
    for (int iy = y; iy < y + h; ++iy) {
      for (int ix = x; ix < x + w; ++ix) pixels[static_cast<std::size_t>(iy * n + ix)] = '\0';
    }
  };
  wall(15, 0, 3, 12);
  wall(30, 36, 3, 14);
  wall(36, 10, 10, 3);
  wall(4, 30, 10, 3);
  return "P5\n50 50\n255\n" + pixels;
}

class Tuning : public ::testing::Test {
 protected:
  Tuning() {
    (void)folder_.write("map.pgm", yard());
    (void)folder_.write("s.toml", text);
  }
  TuneRequest request(int evaluations) const {
    TuneRequest made;
    made.scenario = folder_.file("s.toml");
    made.evaluations = evaluations;
    made.finalists = 1;
    return made;
  }
  RunResult run(const TuneRequest& request, const char* name) const {
    return tune(request, folder_.file(name), Existing::keep, {});
  }
  std::string content(const fs::path& file) const {
    std::ifstream in(folder_.file(file.string()), std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }
  std::string refusal(const TuneRequest& request, const char* name) const {
    try {
      (void)run(request, name);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  ScratchFolder folder_;
};

TEST_F(Tuning, WhatIsToldIsWhatASeparateProofOfTheTunedScenarioFinds) {
  const RunResult result = run(request(20), "out");
  const Scenario tuned = read_scenario(folder_.file("out/scenario.toml"));
  const Progress silent;
  StageClock clock(silent);
  const auto answer = plan_scenario(tuned, clock);
  const Plan& plan = std::get<Planned>(answer).plan;
  const Verification proof = verify_plan(plan, "tuned", region_on_plan({}, plan),
                                         certify_options(tuned.verify.limits, tuned.simulate.seed));
  EXPECT_EQ(result.summary["tuned_share"].get<double>(),
            proof.outcome.volume.all[static_cast<std::size_t>(Verdict::reach)]);
  EXPECT_GE(result.summary["tuned_share"], result.summary["given_share"]);
  EXPECT_EQ(plan_digests(read_plan(folder_.file("out/plan.safetensors"))), plan_digests(plan));
  // Comments and all that was not varied stay.
  const std::string written = content("out/scenario.toml");
  EXPECT_NE(written.find("# A yard."), std::string::npos);
  EXPECT_NE(written.find("cell_m = 2.0  # as fine as the map"), std::string::npos);
}

TEST_F(Tuning, ResumedAfterAnyLineGivesTheSame) {
  (void)run(request(15), "whole");
  const std::string all = content("whole/evaluations.csv");
  for (const double part : {0.3, 0.62, 0.95}) {
    const std::string name = "cut" + std::to_string(part);
    fs::create_directory(folder_.file(name));
    fs::copy(folder_.file("whole/search.json"), folder_.file(name + "/search.json"));
    // In the middle of a line, as a killed process may leave it.
    (void)folder_.write(name + "/evaluations.csv",
                        all.substr(0, static_cast<std::size_t>(part * double(all.size()))));
    TuneRequest again = request(15);
    again.resume = true;
    (void)run(again, name.c_str());
    EXPECT_EQ(content(name + "/evaluations.csv"), all);
    EXPECT_EQ(content(name + "/scenario.toml"), content("whole/scenario.toml"));
    EXPECT_EQ(content(name + "/plan.safetensors"), content("whole/plan.safetensors"));
  }
}

TEST_F(Tuning, KeepsToRangesChoicesAndTheNumberOfEvaluations) {
  TuneRequest asked = request(12);
  asked.parameters = {parameter_of_text("plan.alpha=0.5:1.5"),
                      parameter_of_text("plan.metric=euclidean,octile")};
  (void)run(asked, "out");
  std::istringstream lines(content("out/evaluations.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "evaluation,plan.alpha,plan.metric,allowed,share,safe_share,mean_time_s");
  std::getline(lines, line);
  EXPECT_EQ(line.substr(0, 14), "1,2,euclidean,") << "the scenario as given, whatever the range";
  int count = 1;
  bool octile = false;
  for (; std::getline(lines, line); ++count) {
    const double alpha = std::stod(line.substr(line.find(',') + 1));
    EXPECT_GE(alpha, 0.5);
    EXPECT_LE(alpha, 1.5);
    octile = octile || line.find("octile") != std::string::npos;
  }
  EXPECT_LE(count, 12);
  EXPECT_TRUE(octile);
}

TEST_F(Tuning, RefusesWhatItCannotDo) {
  const auto vary = [](const std::string& what) -> std::string {
    try {
      (void)parameter_of_text(what);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(vary("plan.alpha"), "accepted");
  EXPECT_NE(vary("plan.alpha=2:1"), "accepted");
  EXPECT_NE(vary("plan.alpha=-1:1"), "accepted");
  EXPECT_NE(vary("plan.alpa=1:2"), "accepted");
  EXPECT_NE(vary("plan.metric=a,b"), "accepted");
  EXPECT_THROW((void)objective_of_text("speed=1"), InputError);
  EXPECT_THROW((void)objective_of_text("reach=-1"), InputError);
  TuneRequest resumed = request(5);
  resumed.resume = true;
  EXPECT_NE(refusal(resumed, "nothing").find("holds no search to resume"), std::string::npos);
  (void)run(request(3), "out");
  EXPECT_NE(refusal(request(3), "out").find("--resume continues"), std::string::npos);
  resumed.parameters = {parameter_of_text("plan.beta=1.5:2")};
  EXPECT_NE(refusal(resumed, "out").find("is of another search"), std::string::npos);
  resumed.parameters.clear();
  EXPECT_EQ(refusal(resumed, "out"), "accepted");
  std::string other = yard();
  other[other.size() / 2] = '\0';
  (void)folder_.write("map.pgm", other);
  EXPECT_NE(refusal(resumed, "out").find("is of another search"), std::string::npos)
      << "flights over another map must not mix";
}

TEST_F(Tuning, TheValuesToldAreThoseOfTheScenarioWritten) {
  TuneRequest asked = request(4);
  asked.parameters = {parameter_of_text("plan.mu_border=0.4:0.6")};
  json summary = run(asked, "out").summary;
  const Scenario tuned = read_scenario(folder_.file("out/scenario.toml"));
  const std::string value = value_text(tuned.plan.mu_border);
  EXPECT_EQ(summary["tuned_values"], json::array({value}));
  // Nor is another plan told of which just as much is proved.
  summary["finalists"].push_back({{"values", {"0.123"}}, {"share", summary["tuned_share"]}});
  EXPECT_NE(tuning_words(summary, "out").find("plan.mu_border = " + value), std::string::npos);
  summary["given_share"] = json();
  EXPECT_NE(tuning_words(summary, "out").find("as given does not allow the mission"),
            std::string::npos);
}

TEST(ValueOf, APlanUnderWhichNothingArrivesIsNotTheFastest) {
  const Evaluation given{{}, true, 0.5, 0.5, 20.0};
  const Evaluation nothing{{}, true, 0.0, 0.0, 0.0};
  const Evaluation faster{{}, true, 0.5, 0.5, 10.0};
  const Objective time = objective_of_text("time=1");
  EXPECT_GT(value_of(faster, given, time), value_of(nothing, given, time));
}

TEST(SearchBox, FindsTheHigherOfTwoStepsAndThenItsTop) {
  // Two steps, the higher one narrow, with a slope on top: no search by slopes finds it.
  double best = 0.0;
  int asked = 0;
  const std::vector<double> start{0.9, 0.9};
  search_box(start, 120, [&](std::span<const double> at) -> std::optional<double> {
    ++asked;
    const bool high = at[0] > 0.2 && at[0] < 0.35;
    const double value = (high ? 1.0 : at[0] > 0.5 ? 0.5 : 0.0) - 0.1 * std::abs(at[1] - 0.3);
    best = std::max(best, value);
    return value;
  });
  EXPECT_LE(asked, 120);
  EXPECT_GT(best, 0.998);
}

TEST(EditedScenario, KeepsCommentsAddsKeysAndManagesOtherForms) {
  const std::vector<ScenarioOverride> others{{"plan.alpha", "0.7"}, {"verify.time_limit_s", "9"}};
  const std::string edited = edited_scenario(text, "a/s.toml", others, "b");
  EXPECT_NE(edited.find("alpha = 0.7  # wide"), std::string::npos) << edited;
  EXPECT_NE(edited.find("file = \"../a/map.pgm\""), std::string::npos) << edited;
  EXPECT_EQ(scenario_of_text(edited, "b/s.toml").verify.limits.time_limit_s, 9.0);
  std::string dotted = text;
  dotted.replace(dotted.find("[plan]\nalpha = 2.0"), 18, "[plan]\n\"alpha\" = 2.0");
  const Scenario read = scenario_of_text(edited_scenario(dotted, "a/s.toml", others, "b"), "b/s");
  EXPECT_EQ(read.plan.alpha, 0.7);
  EXPECT_EQ(read.vehicle.turn_radius_m, 5.0);
}

}  // namespace
}  // namespace fairway
