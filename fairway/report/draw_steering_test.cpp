#include "fairway/report/draw_steering.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/report/testing/reading_pictures.hpp"

namespace fairway {
namespace {

using testing::elements_of_layer;
using testing::has_layer;
using testing::has_text;
using testing::read_png;

/// A quarter turn to the left of radius 10 and 30 m straight on, from (0, 0) heading east.
SteeringPicture quarter_and_straight() {
  SteeringPicture picture;
  picture.title = "a turn";
  picture.turn_radius_m = 10.0;
  const FlightSegment turn{{{0.0, 0.0}, Heading()}, 0.0, 5.0 * pi, 0.1};
  const FlightSegment straight{state_at(turn, turn.length_m), 5.0 * pi, 30.0, 0.0};
  picture.goals = {state_at(straight, 30.0)};
  picture.path = {"law: LS, 45.7 m", {turn, straight}};
  picture.values = {{"V", {0.0, 45.7}, {4.57, 0.0}, {}}};
  picture.value_label = "V (turning radii)";
  return picture;
}

TEST(DrawSteering, ShowsPathCirclesPosesAndTheChart) {
  SteeringPicture picture = quarter_and_straight();
  picture.compared = SteeredPath{"shortest: LS, 45.7 m", picture.path.segments};
  const std::string svg = draw_steering(picture).svg;
  for (const char* text : {"a turn", "start", "goal", "law: LS, 45.7 m", "shortest: LS, 45.7 m",
                           "circles of least radius, 10 m", "V", "driven (m)", "x (m)"}) {
    EXPECT_TRUE(has_text(svg, text)) << text;
  }
  EXPECT_EQ(elements_of_layer(svg, "circles").size(), 4U);
  EXPECT_TRUE(has_layer(svg, "series-1"));
  EXPECT_FALSE(elements_of_layer(svg, "path").at(0).attributes.contains("stroke-dasharray"));
  EXPECT_TRUE(elements_of_layer(svg, "compared").at(0).attributes.contains("stroke-dasharray"));
  // The turn is an arc, not chords.
  EXPECT_NE(elements_of_layer(svg, "path").at(0).attributes.at("d").find('A'), std::string::npos);
}

TEST(DrawSteering, WaypointsHaveNumbersAndAGoalHasNone) {
  SteeringPicture picture = quarter_and_straight();
  picture.values.clear();
  EXPECT_FALSE(has_text(draw_steering(picture).svg, "1"));
  picture.goals.push_back({{0.0, 0.0}, Heading()});
  const std::string svg = draw_steering(picture).svg;
  EXPECT_TRUE(has_text(svg, "1"));
  EXPECT_TRUE(has_text(svg, "2"));
  EXPECT_TRUE(has_text(svg, "waypoints"));
  EXPECT_FALSE(has_layer(svg, "series-1"));
}

TEST(DrawSteering, EverythingIsOnThePageAtAnyScaleAndAnyPlace) {
  for (const double scale : {1e-200, 1e-3, 1.0, 1e6, 1e80}) {
    for (const Vec2 place : {Vec2{0.0, 0.0}, Vec2{-3e9, 7e9}}) {
      SteeringPicture picture = quarter_and_straight();
      picture.turn_radius_m *= scale;
      const auto moved = [&](State& s) { s.position_m = scale * s.position_m + scale * place; };
      moved(picture.start = State{});
      for (State& goal : picture.goals) moved(goal);
      for (FlightSegment& piece : picture.path.segments) {
        moved(piece.start);
        piece.length_m *= scale;
        piece.curvature_per_m /= scale;
      }
      const Picture drawn = draw_steering(picture);
      EXPECT_EQ(drawn.svg.find("nan"), std::string::npos) << scale;
      EXPECT_EQ(drawn.svg.find("inf"), std::string::npos) << scale;
      const auto png = read_png(drawn.png);
      EXPECT_LT(png.width, 2400) << scale;
      EXPECT_LT(png.height, 2400) << scale;
    }
  }
}

TEST(DrawSteering, APathWithoutLengthIsDrawnToo) {
  SteeringPicture picture;
  picture.goals = {picture.start};
  picture.path.name = "LSL, 0 m";
  picture.values = {{"V", {0.0}, {0.0}, {}}};
  EXPECT_TRUE(has_text(draw_steering(picture).svg, "LSL, 0 m"));
}

TEST(DrawSteering, RefusesSizesOutOfRange) {
  SteeringPicture picture = quarter_and_straight();
  picture.map_pt = 10.0;
  EXPECT_THROW((void)draw_steering(picture), PreconditionViolation);
  picture = quarter_and_straight();
  picture.turn_radius_m = 0.0;
  EXPECT_THROW((void)draw_steering(picture), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
