// What docs/steering.md and docs/papers.md say of paper 3's law.
#include <gtest/gtest.h>

#include "reproduce/steering_figures.hpp"

namespace fairway::reproduce {
namespace {

TEST(SteeringClaims, TheFiguresHaveThePathsThePaperNames) {
  const std::vector<SteeringExample> examples = steering_examples();
  const std::vector<std::string> words{"LSL", "LRSL", "RS", "LSL", "RSR", "LSR"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    EXPECT_EQ(examples[i].flight.word, words[i]) << examples[i].figure;
    EXPECT_TRUE(examples[i].flight.converged);
    EXPECT_NEAR(examples[i].flight.length_m, examples[i].shortest.length_m(), 0.05);
    EXPECT_EQ(examples[i].repelled, i == 1) << examples[i].figure;
  }
  // The three-turn case: the straight part is what is left of a jump from circle to circle.
  EXPECT_EQ(examples[1].shortest.word, DubinsWord::LRL);
}

TEST(SteeringClaims, TheLawConvergesEverywhereAndIsShortestFromMostStartsNotFromAll) {
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
