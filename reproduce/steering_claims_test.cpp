// What docs/steering.md and docs/papers.md say about paper 3's law.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "reproduce/steering_figures.hpp"
#include "reproduce/steering_robustness.hpp"

namespace fairway::reproduce {
namespace {

TEST(SteeringClaims, TheFiguresHaveThePathsThePaperNames) {
  const std::vector<SteeringExample> examples = steering_examples();
  const std::vector<std::string> words{"LSL", "RLSR", "RS", "LSL", "RSR", "LSR"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    EXPECT_EQ(examples[i].flight.word, words[i]) << examples[i].figure;
    EXPECT_TRUE(examples[i].flight.converged);
    EXPECT_NEAR(examples[i].flight.length_m, examples[i].shortest.length_m(), 0.05);
    EXPECT_EQ(examples[i].repelled, i == 1) << examples[i].figure;
  }
  // The three-turn case: the straight part is what is left of a jump from circle to circle.
  EXPECT_EQ(examples[1].shortest.word, DubinsWord::RLR);
}

TEST(SteeringClaims, Figure6PushesTheLeftCircleAwayThenTheRightOneUntil1Point5) {
  const SteeringExample example = steering_examples()[1];
  const State goal{{0.0, 0.0}, Heading::from_rad(pi / 2)};
  ClfLaw law;
  ClfValue value = law.value(example.start, goal, 1.0);
  EXPECT_LT(value.d_ll, value.d_rr);
  // Which circle is pushed in turn, and how far had been driven when that ended.
  std::vector<std::pair<char, double>> pushed;
  double driven = 0.0;
  for (const State& s : example.flight.track) {
    value = law.value(s, goal, 1.0);
    const bool left = value.repels_left && (value.d_ll <= value.d_rr || !value.repels_right);
    const char now = left ? 'L' : value.repels_right ? 'R' : 'A';
    if (pushed.empty() || pushed.back().first != now) pushed.emplace_back(now, 0.0);
    driven += 0.01;
    pushed.back().second = driven;
    if (now == 'A') break;
    static_cast<void>(law.curvature_per_m(s, goal, 1.0, 0.01));
  }
  ASSERT_EQ(pushed.size(), 3U);
  EXPECT_EQ(pushed[0].first, 'L');
  EXPECT_NEAR(pushed[0].second, 0.73, 0.02);
  EXPECT_EQ(pushed[1].first, 'R');
  EXPECT_NEAR(pushed[1].second, 1.5, 0.02);
  EXPECT_LT(value.d_ll, value.d_rr);  // D_LL' is the one that is reduced then
}

TEST(SteeringClaims, BothLawsCatchMovingGoalsAndTolerateNoise) {
  for (const RobustnessRow& row : steering_robustness(60)) {
    for (std::size_t law = 0; law < law_names.size(); ++law) {
      EXPECT_EQ(row.caught[law], row.starts)
          << law_names[law] << ", tolerance " << row.tolerance << ", noise " << row.noise
          << ", speed " << row.goal_speed;
    }
    EXPECT_LT(row.median_driven[0], 1.1 * row.median_driven[1]);
  }
}

TEST(SteeringClaims, TheLawConvergesEverywhereAndIsShortestFromMostStartsButNotAll) {
  for (const Repulsion repulsion : {Repulsion::none, Repulsion::overlap_behind}) {
    const SteeringStudy study = study_of(repulsion, 16, 16);
    EXPECT_EQ(study.converged, 1.0) << study.name;
    EXPECT_GT(study.shortest, 0.75) << study.name;
    EXPECT_LT(study.shortest, 0.95) << study.name;
    EXPECT_GT(study.worst_ratio, 1.5) << study.name;
    EXPECT_LT(study.worst_ratio, 8.0) << study.name;
  }
}

TEST(SteeringClaims, RepulsionMakesMorePathsShortest) {
  EXPECT_GT(study_of(Repulsion::overlap_behind, 16, 16).shortest,
            study_of(Repulsion::none, 16, 16).shortest);
}

}  // namespace
}  // namespace fairway::reproduce
