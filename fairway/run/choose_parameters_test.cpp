#include "fairway/run/choose_parameters.hpp"

#include <fstream>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "fairway/map/testing/scratch_folder.hpp"
#include "fairway/run/run.hpp"

namespace fairway {
namespace {

/// Blocks of houses: streets of `street` cells between blocks of 6.
ObstacleMap blocks(int street) {
  ObstacleMap map;
  const int side = 6 + street;
  const int n = 8 * side + street;
  map.grid = {n, n, 0.0, 0.0, 2.0};
  for (int iy = 0; iy < n; ++iy) {
    for (int ix = 0; ix < n; ++ix) {
      const bool is_rim = ix == 0 || iy == 0 || ix == n - 1 || iy == n - 1;
      // A square is left out in the middle, for the goal.
      const bool is_square = std::abs(ix - n / 2) < 18 && std::abs(iy - n / 2) < 18;
      const bool is_block = ix % side >= street && iy % side >= street;
      map.obstacle.push_back(is_rim || (is_block && !is_square) ? 1 : 0);
    }
  }
  return map;
}

constexpr Vehicle car{5.0, 5.0};

ChosenParameters chosen_on(const ObstacleMap& map) {
  const GoalMission goal{map.grid.center({map.grid.nx / 2, map.grid.ny / 2}), {}};
  return choose_parameters(map, car, goal,
                           candidate_options({}, {true, true}, car, map.grid.cell_m));
}

TEST(ChooseParameters, TriesEachCandidateOnceThePapersFirst) {
  const auto all = candidate_options({}, {true, true}, car, 2.0);
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all.front().alpha, FieldOptions{}.alpha);
  EXPECT_EQ(all.front().sigma_cells, FieldOptions{}.sigma_cells);
  // A buffer of 1.01 cells holds the cells beside an obstacle, and no others.
  EXPECT_NEAR(all.back().alpha * car.turn_radius_m / 2.0, 1.01, 1e-12);
}

TEST(ChooseParameters, KeepsWhatIsGiven) {
  FieldOptions asked;
  asked.alpha = 0.7;
  for (const FieldOptions& one : candidate_options(asked, {false, true}, car, 2.0)) {
    EXPECT_EQ(one.alpha, 0.7);
  }
  const auto alone = candidate_options(asked, {false, false}, car, 2.0);
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_EQ(alone.front().sigma_cells, asked.sigma_cells);
}

TEST(ChooseParameters, TakesANarrowBufferWhereStreetsAreNarrow) {
  const ChosenParameters chosen = chosen_on(blocks(6));
  EXPECT_LT(chosen.options.alpha, 1.0);
  ASSERT_TRUE(chosen.tried.front().flown);
  for (const TriedParameters& one : chosen.tried) {
    if (one.options.alpha == chosen.options.alpha) {
      EXPECT_GT(one.flown->share(), chosen.tried.front().flown->share() + 0.1);
    }
  }
}

TEST(ChooseParameters, NeverTakesWhatBringsFewerStatesThanThePapers) {
  for (const int street : {5, 7, 10, 14, 20}) {
    const ChosenParameters chosen = chosen_on(blocks(street));
    double papers = 0.0;
    double taken = 0.0;
    for (const TriedParameters& one : chosen.tried) {
      if (!one.flown) continue;
      if (&one == &chosen.tried.front()) papers = one.flown->share();
      if (one.options.alpha == chosen.options.alpha &&
          one.options.sigma_cells == chosen.options.sigma_cells) {
        taken = one.flown->share();
      }
    }
    EXPECT_GE(taken, papers) << street;
  }
}

TEST(Presets, ThePapersIsTheSamePlanToTheByteAsItsKeys) {
  const ScratchFolder folder;
  std::string image = "P5\n80 80\n255\n" + std::string(80 * 80, '\xff');
  for (int k = 0; k < 30; ++k) image[image.size() - 80 * 40 + static_cast<std::size_t>(k)] = '\0';
  (void)folder.write("map.pgm", image);
  const std::string text =
      "[map]\nfile = \"map.pgm\"\nresolution_m = 2.0\ncell_m = 2.0\n[vehicle]\nspeed_mps = 5.0\n"
      "turn_radius_m = 5.0\n[mission]\nkind = \"goal\"\ngoal_m = [90.0, 90.0]\n";
  const auto planned = [&](const std::string& plan) {
    const Scenario scenario = scenario_of_text(text + plan, folder.file("s.toml"));
    std::ofstream(folder.file("s.toml")) << text + plan;
    const Progress silent;
    StageClock clock(silent);
    return std::get<Planned>(plan_scenario(scenario, clock));
  };
  const Planned papers = planned("[plan]\npreset = \"paper\"\n");
  const Planned keys = planned("[plan]\nalpha = 2.0\nbeta = 2.0\nsigma_cells = 1.0\n");
  EXPECT_TRUE(papers.tried.empty());
  EXPECT_EQ(papers.plan.record.options_json, keys.plan.record.options_json);
  EXPECT_EQ(papers.plan.region, keys.plan.region);
  EXPECT_EQ(papers.plan.cost_m, keys.plan.cost_m);
  for (std::size_t i = 0; i < papers.plan.heading_rad.size(); ++i) {
    const float a = papers.plan.heading_rad[i];
    const float b = keys.plan.heading_rad[i];
    ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
  }
  // A key beside it still counts, and the record says what the plan was made with.
  const Planned mixed = planned("[plan]\nalpha = 0.6\npreset = \"paper\"\n");
  EXPECT_EQ(mixed.scenario.plan.alpha, 0.6);
  EXPECT_EQ(mixed.scenario.plan.sigma_cells, 1.0);
}

}  // namespace
}  // namespace fairway
