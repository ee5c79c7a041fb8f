#include "fairway/run/start_warnings.hpp"

#include <gtest/gtest.h>

namespace fairway {
namespace {

Plan plan_of_ten_cells() {
  Plan plan;
  plan.grid = {10, 10, -5.0, -5.0, 1.0};
  plan.region.assign(100, Region::free);
  plan.region[plan.grid.index({2, 3})] = Region::obstacle;
  return plan;
}

TEST(ObstacleWarnings, TellTheFirstStartInAnObstacleAndHowManyThereAre) {
  const Plan plan = plan_of_ten_cells();
  const State inside{{-2.5, -1.5}, Heading()};
  const State free{{0.5, 0.5}, Heading()};
  const State outside{{99.0, 0.5}, Heading()};
  EXPECT_TRUE(obstacle_warnings(std::vector{free, outside}, plan).empty());
  EXPECT_TRUE(obstacle_warnings({}, plan).empty());
  EXPECT_EQ(obstacle_warnings(std::vector{free, inside}, plan),
            std::vector<std::string>{"1 of the scenario's 2 states lies in an obstacle, at (-2.5, "
                                     "-1.5): it has collided before it moves."});
  EXPECT_EQ(obstacle_warnings(std::vector{inside, inside}, plan),
            std::vector<std::string>{
                "2 of the scenario's 2 states lie in an obstacle, the first at (-2.5, -1.5): they "
                "have collided before they move."});
}

TEST(DegreeWarnings, TellLatitudeAndLongitudeTypedAsMetres) {
  const Grid grid{100, 100, -50.0, -50.0, 1.0};
  Frame frame;
  frame.geo = GeoReference{47.3977, 8.5456, 0.0};
  const auto warned = [&](double x, double y, const Frame& f) {
    return !degree_warnings(std::vector<State>{{{0.0, 0.0}, {}}, {{x, y}, {}}}, grid, f).empty();
  };
  EXPECT_TRUE(warned(47.398, 8.545, frame));
  EXPECT_TRUE(warned(8.545, 47.398, frame));
  EXPECT_FALSE(warned(47.398, 8.545, {}));
  EXPECT_FALSE(warned(40.0, 8.545, frame));
  EXPECT_FALSE(warned(-47.398, 8.545, frame));
}

}  // namespace
}  // namespace fairway
