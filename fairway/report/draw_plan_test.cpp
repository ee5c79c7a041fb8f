#include "fairway/report/draw_plan.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <tbb/global_control.h>

#include "fairway/base/error.hpp"
#include "fairway/report/cell_layer.hpp"
#include "fairway/report/map_page.hpp"
#include "fairway/report/testing/plans_to_draw.hpp"
#include "fairway/report/testing/reading_pictures.hpp"

namespace fairway {
namespace {

using testing::has_layer;
using testing::has_text;
using testing::read_png;

const Grid grid{40, 30, 1000.0, -200.0, 8.0};
const Cell rock{10, 20};
const Vec2 goal = grid.center({30, 8});

Plan plan() { return testing::island_plan(grid, goal, rock); }

/// Where a place lies in the PNG: the page is laid out again, since the layout is not in the file.
Color color_at(const Plan& p, const PlanPictureOptions& options, Vec2 place_m) {
  MapPage page(
      p, {options.title, options.cost, options.mission, options.frame_pt, options.pixels_per_pt},
      {});
  const Vec2 at = page.frame().to_page(place_m);
  const auto png = read_png(draw_plan(p, options).png);
  return png.at(at.x * options.pixels_per_pt, at.y * options.pixels_per_pt);
}

TEST(DrawPlan, ColoursShowTheRegionsWhereTheyAre) {
  const PlanPictureOptions options{.title = "Title", .streamlines = false};
  Plan p = plan();
  EXPECT_EQ(color_at(p, options, grid.center(rock)), palette::obstacle);
  EXPECT_EQ(color_at(p, options, grid.center({rock.ix + 2, rock.iy - 2})), palette::obstacle);
  const Cell far{2, 28};
  const double share = p.cost_m[grid.index(far)] / largest_cost_m(p);
  // Off the centre: contour lines run between centres.
  EXPECT_EQ(color_at(p, options, grid.corner(far) + Vec2{1.0, 1.0}), cost_ramp(share));
  PlanPictureOptions bare = options;
  bare.cost = false;
  EXPECT_EQ(color_at(p, bare, grid.center({20, 15})), palette::free);
}

TEST(DrawPlan, TheBufferIsItsColourOrItsPattern) {
  const PlanPictureOptions options{.streamlines = false};
  const Plan p = plan();
  int ground = 0;
  for (double d = 0.5; d < 8.0; d += 1.0)
    ground +=
        color_at(p, options, grid.corner({rock.ix + 3, rock.iy}) + Vec2{d, 4.0}) == palette::buffer
            ? 1
            : 0;
  EXPECT_GE(ground, 3);
}

TEST(DrawPlan, EveryPartIsANamedLayer) {
  PlanPictureOptions options{.title = "All of it", .arrows = true};
  options.mission = GoalMission{goal, 1.0};
  const Picture picture = draw_plan(plan(), options);
  for (const char* layer : {"cells", "patterns", "contours", "streamlines", "arrows", "mission",
                            "axes", "color-bar", "legend", "scale-bar", "title"})
    EXPECT_TRUE(has_layer(picture.svg, layer)) << layer;
  for (const char* text : {"All of it", "x (m)", "y (m)", "cost to go (m)", "buffer", "obstacle",
                           "goal", "goal point", "streamline", "command"})
    EXPECT_TRUE(has_text(picture.svg, text)) << text;
  EXPECT_FALSE(has_text(picture.svg, "path to follow"));
}

TEST(DrawPlan, PartsSwitchedOffAreNotDrawn) {
  const Picture picture = draw_plan(plan(), {.cost = false, .streamlines = false});
  for (const char* layer : {"contours", "streamlines", "arrows", "mission", "color-bar", "title"})
    EXPECT_FALSE(has_layer(picture.svg, layer)) << layer;
  EXPECT_TRUE(has_text(picture.svg, "safe start"));
}

TEST(DrawPlan, UnreachableCellsAreCountedNamedAndHatched) {
  Plan p = plan();
  const Picture before = draw_plan(p, {.streamlines = false});
  for (int iy = 2; iy < 6; ++iy)
    for (int ix = 2; ix < 6; ++ix)
      p.cost_m[grid.index({ix, iy})] = std::numeric_limits<float>::infinity();
  const Picture after = draw_plan(p, {.streamlines = false});
  EXPECT_TRUE(has_text(after.svg, "cut off (16 cells)"));
  EXPECT_EQ(testing::elements_of_layer(after.svg, "patterns").size(),
            testing::elements_of_layer(before.svg, "patterns").size() + 2);
}

TEST(DrawPlan, AGoalHeadingAndAPathAreDrawn) {
  PlanPictureOptions options{.streamlines = false};
  options.mission = GoalMission{goal, {}};
  const auto cross = testing::elements_of_layer(draw_plan(plan(), options).svg, "mission").size();
  options.mission = GoalMission{goal, 0.7};
  EXPECT_EQ(testing::elements_of_layer(draw_plan(plan(), options).svg, "mission").size(),
            cross + 2);
  PathMission path{{{1010, -150}, {1200, -150}, {1200, -20}}, false};
  options.mission = path;
  const Picture open = draw_plan(plan(), options);
  EXPECT_TRUE(has_text(open.svg, "path to follow"));
  path.closed = true;
  options.mission = path;
  EXPECT_NE(draw_plan(plan(), options).svg, open.svg);
}

RC_GTEST_PROP(DrawPlan, AnyPlanOfAnySizeGivesAPicture, (std::uint64_t seed)) {
  Random random(seed);
  const Plan p = testing::wild_plan(random);
  PlanPictureOptions options{
      .title = "wild", .arrows = true, .frame_pt = 100.0, .pixels_per_pt = 1.0};
  options.streamlines_across = 1 + static_cast<int>(random.below(20));
  options.arrows_across = 1 + static_cast<int>(random.below(20));
  const Picture picture = draw_plan(p, options);
  RC_ASSERT(has_layer(picture.svg, "axes"));
  RC_ASSERT(read_png(picture.png).height > 0);
}

TEST(DrawPlan, EmptySingleAndThinPlansGivePictures) {
  for (const auto& [nx, ny] : {std::pair{0, 0}, {1, 1}, {1, 300}, {300, 1}, {0, 7}}) {
    Plan p = testing::plan_of(
        {nx, ny, 0.0, 0.0, 5.0}, [](Vec2 q) { return std::abs(q.x + q.y); },
        [](Vec2) { return 0.3; });
    const Picture picture = draw_plan(p, {.title = "thin", .arrows = true});
    EXPECT_TRUE(has_text(picture.svg, "thin")) << nx << " x " << ny;
    EXPECT_GT(read_png(picture.png).width, 100);
  }
}

TEST(DrawPlan, TheBytesDoNotDependOnTheNumberOfThreads) {
  const Plan p = testing::island_plan({200, 300, 0.0, 0.0, 4.0}, {600.0, 800.0}, {60, 100});
  const Picture all = draw_plan(p, {.title = "threads"});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Picture single = draw_plan(p, {.title = "threads"});
  EXPECT_EQ(all.svg, single.svg);
  EXPECT_EQ(all.png, single.png);
}

TEST(DrawPlan, ABigPlanGivesAnSvgSmallEnoughForAPaper) {
  const Plan p = testing::island_plan({1000, 1000, 0.0, 0.0, 4.0}, {3100.0, 2900.0}, {400, 400});
  EXPECT_LT(draw_plan(p, {}).svg.size(), 1'500'000U);
}

TEST(DrawPlan, CallerMistakesAreReported) {
  Plan p = plan();
  EXPECT_THROW(static_cast<void>(draw_plan(p, {.frame_pt = 0.0})), PreconditionViolation);
  EXPECT_THROW(static_cast<void>(draw_plan(p, {.pixels_per_pt = 99.0})), PreconditionViolation);
  EXPECT_THROW(static_cast<void>(draw_plan(p, {.arrows_across = 0})), PreconditionViolation);
  p.cost_m.pop_back();
  EXPECT_THROW(static_cast<void>(draw_plan(p, {})), PreconditionViolation);
}

TEST(CellLayer, BigPlansAreAveragedBlockByBlockWithTheTopRowFirst) {
  Plan p = testing::plan_of(
      {5, 4, 0.0, 0.0, 1.0}, [](Vec2) { return 0.0; }, [](Vec2) { return 0.0; });
  p.region[p.grid.index({0, 0})] = Region::obstacle;
  const CellLayer layer = cell_layer(p, false, 3);
  ASSERT_EQ(layer.cells_per_pixel, 2);
  ASSERT_EQ(layer.raster.width, 3);
  ASSERT_EQ(layer.raster.height, 2);
  const Color& mixed = layer.raster.pixels[3];  // lower left block: one obstacle, three free
  EXPECT_EQ(mixed.red, (palette::obstacle.red + 3 * palette::free.red + 2) / 4);
  EXPECT_EQ(layer.raster.pixels[0], palette::free);
}

}  // namespace
}  // namespace fairway
