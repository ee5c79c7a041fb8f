#include "fairway/report/page_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

const Grid grid{80, 40, -200.0, 100.0, 5.0};

/// A plane of degrees around a place, longitudes in [-180, 180].
LonLatOf degrees_about(double latitude_deg, double longitude_deg) {
  return [=](Vec2 p) {
    return LonLat{std::remainder(longitude_deg + p.x / 1e5, 360.0), latitude_deg + p.y / 1e5};
  };
}

TEST(PageFrame, HasDegreesAtALatticeOverTheGridItsFirstRowLowest) {
  const auto found = page_frame_json(grid, {}, degrees_about(47.0, 8.0))["earth"];
  const int across = found["across"];
  ASSERT_EQ(found["lat_deg"].size(), static_cast<std::size_t>(across * across));
  const auto at = [&](const char* name, int row, int column) {
    return found[name][static_cast<std::size_t>(row * across + column)].get<double>();
  };
  for (const int row : {0, 3, across - 1}) {
    for (const int column : {0, 5, across - 1}) {
      EXPECT_NEAR(at("lat_deg", row, column), 47.0 + (100.0 + 200.0 * row / (across - 1)) / 1e5,
                  1e-8);
      EXPECT_NEAR(at("lon_deg", row, column), 8.0 + (-200.0 + 400.0 * column / (across - 1)) / 1e5,
                  1e-8);
    }
  }
}

TEST(PageFrame, LongitudesHaveNoJumpAtTheDateLine) {
  const auto found = page_frame_json(grid, {}, degrees_about(-17.0, 180.0))["earth"];
  double least = 1e9;
  double most = -1e9;
  for (const double lon : found["lon_deg"]) {
    least = std::min(least, lon);
    most = std::max(most, lon);
  }
  EXPECT_NEAR(most - least, 400.0 / 1e5, 1e-8);
}

TEST(PageFrame, HasNoDegreesWhenNotGeoreferenced) {
  EXPECT_TRUE(page_frame_json(grid, {}, {})["earth"].is_null());
  const LonLatOf outside = [](Vec2) -> LonLat { throw InputError("map", "outside its system"); };
  EXPECT_TRUE(page_frame_json(grid, {}, outside)["earth"].is_null());
  const LonLatOf nowhere = [](Vec2) {
    return LonLat{std::numeric_limits<double>::infinity(), 0.0};
  };
  EXPECT_TRUE(page_frame_json(grid, {}, nowhere)["earth"].is_null());
}

TEST(PageFrame, SaysHowTheGridIsTurned) {
  Frame frame;
  EXPECT_EQ(page_frame_json(grid, frame, {})["yaw_rad"], 0.0);
  frame.world_from_grid.yaw_rad = 3.14;
  EXPECT_EQ(page_frame_json(grid, frame, {})["yaw_rad"], 3.14);
}

}  // namespace
}  // namespace fairway
