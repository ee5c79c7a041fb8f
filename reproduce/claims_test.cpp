// The claims of paper 1's text about Figs. 6 to 8, tested on our own map. Orders and ratios,
// not digits: the paper's maps are not published.
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "reproduce/buffer_measures.hpp"
#include "reproduce/figures.hpp"
#include "reproduce/world.hpp"

namespace fairway::reproduce {
namespace {

double mean_spike_m(const PathRow& row) {
  return std::accumulate(row.lap.corner_m.begin(), row.lap.corner_m.end(), 0.0) /
         static_cast<double>(row.lap.corner_m.size());
}

class PaperClaims : public ::testing::TestWithParam<FieldOptions> {
 protected:
  static const Reproduction& figures(const FieldOptions& options) {
    static std::map<Metric, Reproduction> made;
    auto& one = made[options.metric];
    if (one.pictures.empty())
      one = reproduce_figures(std::filesystem::path(FAIRWAY_SOURCE_DIR) / "demo", options);
    return one;
  }
};

TEST_P(PaperClaims, EveryFigureIsDrawn) {
  for (const char* name : {"fig3", "fig4a", "fig4b", "fig5a", "fig5b", "fig6a", "fig6b", "fig7a",
                           "fig7b", "fig8a", "fig8b"}) {
    const auto& pictures = figures(GetParam()).pictures;
    ASSERT_TRUE(pictures.contains(name)) << name;
    EXPECT_GT(pictures.at(name).svg.size(), 1000U) << name;
  }
}

// Over many starts; single flights differ by less than their scatter.
TEST_P(PaperClaims, LargerSigmaGivesSmootherHeadings) {
  const auto& rows = figures(GetParam()).goal_by_sigma;
  ASSERT_EQ(rows.size(), 3U);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_LT(rows[i].mean_rms_rate_radps, rows[i - 1].mean_rms_rate_radps);
    EXPECT_LT(rows[i].mean_largest_rate_radps, rows[i - 1].mean_largest_rate_radps);
    EXPECT_LT(rows[i].mean_turning_rad, rows[i - 1].mean_turning_rad);
  }
}

TEST_P(PaperClaims, LargerSigmaStraysFartherFromThePathAndMostAtItsCorners) {
  const auto& rows = figures(GetParam()).path_by_sigma;
  ASSERT_EQ(rows.size(), 3U);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_GT(rows[i].lap.mean_m, rows[i - 1].lap.mean_m);
    EXPECT_GT(rows[i].lap.max_m, rows[i - 1].lap.max_m);
    EXPECT_GT(mean_spike_m(rows[i]), 1.3 * mean_spike_m(rows[i - 1]));
    EXPECT_GT(mean_spike_m(rows[i]), rows[i].lap.mean_of_straights_m);
  }
}

TEST_P(PaperClaims, CornerSpikesAreAlikeAcrossResolutionsWithTheSameSigmaInMetres) {
  const auto& rows = figures(GetParam()).path_by_cell;
  ASSERT_EQ(rows.size(), 3U);
  for (const PathRow& row : rows) {
    EXPECT_NEAR(mean_spike_m(row), mean_spike_m(rows[0]), 0.1 * mean_spike_m(rows[0]));
    for (std::size_t c = 0; c < row.lap.corner_m.size(); ++c)
      EXPECT_NEAR(row.lap.corner_m[c], rows[0].lap.corner_m[c], 4.0) << "corner " << c;
  }
}

TEST_P(PaperClaims, TheCoarsestResolutionIsTheLeastSmooth) {
  const auto& rows = figures(GetParam()).goal_by_cell;  // 2, 4, 8 m
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_GT(rows[2].mean_rms_rate_radps, rows[1].mean_rms_rate_radps);
  EXPECT_GT(rows[2].mean_rms_rate_radps, rows[0].mean_rms_rate_radps);
  EXPECT_GT(rows[2].mean_largest_rate_radps, rows[0].mean_largest_rate_radps);
}

TEST_P(PaperClaims, EveryFlightOfTheFiguresReachesTheGoalAndNearlyAllRandomOnesDo) {
  for (const auto* rows : {&figures(GetParam()).goal_by_sigma, &figures(GetParam()).goal_by_cell})
    for (const GoalRow& row : *rows) {
      EXPECT_TRUE(std::isfinite(row.drawn_time_s)) << row.name;
      EXPECT_GE(row.reached_share, 0.99) << row.name;
    }
}

// docs/field.md: Eq. 3 measures from point to point, the program from centre to centre.
TEST(BufferClaims, TheBufferKeepsItsWidthLessACellsDiagonalAndThePapersAllOfIt) {
  const auto demo = std::filesystem::path(FAIRWAY_SOURCE_DIR) / "demo" / "demo.toml";
  struct Documented {
    double cell_m, least_m, percent;
  };
  for (const auto& [cell_m, least_m, percent] :
       {Documented{2.0, 37.58, 2.4}, Documented{4.0, 35.78, 4.3}, Documented{8.0, 32.0, 6.1}}) {
    const World world = world_of(demo, cell_m);
    const double r = world.vehicle.turn_radius_m;
    const auto kept = [&](const FieldOptions& options) {
      const Plan plan = plan_in(world, options);
      return buffer_measures(plan.grid, plan.region, 2.0 * r);
    };
    FieldOptions options;
    const BufferMeasures by_default = kept(options);
    EXPECT_GE(by_default.least_m, 2.0 * r - std::sqrt(2.0) * cell_m);
    EXPECT_LT(by_default.least_m, 2.0 * r);
    EXPECT_NEAR(by_default.least_m, least_m, 0.01);
    EXPECT_NEAR(100.0 * by_default.share, percent, 0.1);
    options.alpha = 2.0 + std::sqrt(2.0) * cell_m / r;
    EXPECT_GE(kept(options).least_m, 2.0 * r);
    options = {};
    options.metric = Metric::paper;
    EXPECT_GE(kept(options).least_m, 2.0 * r);
    EXPECT_EQ(kept(options).share, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(ToTheLetterAndByDefault, PaperClaims,
                         ::testing::Values(options_to_the_letter(), FieldOptions{}));

}  // namespace
}  // namespace fairway::reproduce
