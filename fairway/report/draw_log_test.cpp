#include "fairway/report/draw_log.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/report/testing/reading_pictures.hpp"

namespace fairway {
namespace {

using testing::elements_of_layer;
using testing::has_text;
using testing::read_png;

/// A quarter of a circle, and a motion beside it that ends early.
LogPicture quarter() {
  LogPicture picture;
  picture.title = "a log: contract not kept";
  for (int k = 0; k <= 90; ++k) {
    const double angle = k * 3.14159 / 180.0;
    picture.log_m.push_back({100.0 * std::cos(angle), 100.0 * std::sin(angle)});
    if (k < 60) picture.motion_m.push_back({98.0 * std::cos(angle), 98.0 * std::sin(angle)});
  }
  picture.worst_sample = 40;
  picture.worst_name = "worst place, t = 4 s";
  picture.tracking_m = 3.0;
  return picture;
}

TEST(DrawLog, ShowsTheFlightTheMotionAndTheWorstPlace) {
  const Picture drawn = draw_log(quarter());
  for (const char* text : {"a log: contract not kept", "the log", "a motion of the contract",
                           "within 3 m of the log", "worst place, t = 4 s", "x (m)"}) {
    EXPECT_TRUE(has_text(drawn.svg, text)) << text;
  }
  EXPECT_EQ(elements_of_layer(drawn.svg, "flight").size(), 3U);  // tube, log, motion
  EXPECT_EQ(elements_of_layer(drawn.svg, "distance").size(),
            3U);  // circle, dot, line to the motion
  EXPECT_GT(read_png(drawn.png).width, 600);
}

TEST(DrawLog, WithoutAMotionThereIsNoLineToIt) {
  LogPicture picture = quarter();
  picture.motion_m.clear();
  const Picture drawn = draw_log(picture);
  EXPECT_EQ(elements_of_layer(drawn.svg, "flight").size(), 2U);
  EXPECT_EQ(elements_of_layer(drawn.svg, "distance").size(), 2U);
}

TEST(DrawLog, APlaceThatIsNotOfTheLogIsRefused) {
  LogPicture picture = quarter();
  picture.worst_sample = picture.log_m.size();
  EXPECT_THROW(static_cast<void>(draw_log(picture)), PreconditionViolation);
  picture = quarter();
  picture.tracking_m = 0.0;
  EXPECT_THROW(static_cast<void>(draw_log(picture)), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
