#include "fairway/map/earth_frame.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

Frame plane_at(double latitude_deg, double longitude_deg) {
  Frame frame;
  frame.geo = GeoReference{latitude_deg, longitude_deg, 0.0};
  return frame;
}

Frame utm_32() {
  OGRSpatialReference system;
  EXPECT_EQ(system.importFromEPSG(32632), OGRERR_NONE);
  char* text = nullptr;
  EXPECT_EQ(system.exportToWkt(&text), OGRERR_NONE);
  Frame frame;
  frame.projected_crs = text;
  CPLFree(text);
  return frame;
}

TEST(EarthFrame, DegreesAndBackAreTheSameState) {
  Random random(41);
  for (const auto& [frame, middle_m] : {std::pair{plane_at(47.3977, 8.5456), Vec2{}},
                                        {plane_at(-33.9, 179.9999), Vec2{}},
                                        {plane_at(0.0, 0.0), Vec2{}},
                                        {plane_at(78.2, 15.6), Vec2{}},
                                        {utm_32(), Vec2{650'000.0, 5'200'000.0}}}) {
    const EarthFrame earth(frame, "plan");
    for (int draw = 0; draw < 200; ++draw) {
      const Vec2 offset{random.uniform(-2e4, 2e4), random.uniform(-2e4, 2e4)};
      const State state{middle_m + offset, Heading::from_rad(random.uniform(-pi, pi))};
      const EarthState degrees = earth.degrees_of(state);
      EXPECT_GE(degrees.course_deg, 0.0);
      EXPECT_LT(degrees.course_deg, 360.0);
      const State again = earth.state_of(degrees, "again");
      EXPECT_LT(norm(again.position_m - state.position_m), 1e-6);
      EXPECT_NEAR(again.heading.turn_to(state.heading), 0.0, 1e-8);
    }
  }
}

TEST(EarthFrame, CoursesAreClockwiseFromNorth) {
  const EarthFrame earth(plane_at(47.3977, 8.5456), "plan");
  const auto heading = [&](double course_deg) {
    return earth.state_of({47.3977, 8.5456, course_deg}, "state").heading.rad();
  };
  EXPECT_NEAR(heading(0.0), pi / 2.0, 1e-8);
  EXPECT_NEAR(heading(90.0), 0.0, 1e-8);
  EXPECT_NEAR(heading(135.0), -pi / 4.0, 1e-8);
  EXPECT_NEAR(heading(-90.0), heading(270.0), 1e-12);
  EXPECT_EQ(heading(360.0), heading(0.0));
}

// Flown along a course by geodesy: on a projected map a course is no angle to +y.
TEST(EarthFrame, AStepAlongACourseLeadsWhereTheHeadingPoints) {
  Random random(42);
  const EarthFrame earth(utm_32(), "plan");  // 3 degrees east of its meridian: north is 2 off
  for (int draw = 0; draw < 100; ++draw) {
    const EarthState from{random.uniform(44.0, 50.0), random.uniform(11.0, 12.0),
                          random.uniform(0.0, 360.0)};
    const double step_deg = 1e-5;
    const double course_rad = from.course_deg * pi / 180.0;
    EarthState to = from;
    to.latitude_deg += step_deg * std::cos(course_rad);
    to.longitude_deg += step_deg * std::sin(course_rad) / std::cos(from.latitude_deg * pi / 180.0);
    const State a = earth.state_of(from, "a");
    const Vec2 step = earth.state_of(to, "b").position_m - a.position_m;
    // A degree of latitude is up to 0.5 % shorter than one of a great circle in longitude.
    EXPECT_NEAR(Heading::of(step).turn_to(a.heading), 0.0, 0.005);
    EXPECT_GT(std::abs(Heading::from_rad(pi / 2.0 - course_rad).turn_to(a.heading)), 0.02);
  }
}

TEST(EarthFrame, PlacesThatAreNotOnTheMapAreRefusedByName) {
  const auto refusal = [](const Frame& frame, const EarthState& state) -> std::string {
    try {
      (void)EarthFrame(frame, "plan.safetensors").state_of(state, "--state-deg");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_TRUE(
      refusal({}, {47.0, 8.0, 0.0}).starts_with("plan.safetensors: the map is not georeferenced"));
  EXPECT_EQ(refusal(plane_at(47.3977, 8.5456), {47.3977, 8.5456, 0.0}), "accepted");
  const std::string swapped = refusal(plane_at(47.3977, 8.5456), {8.5456, 47.3977, 0.0});
  EXPECT_TRUE(swapped.starts_with("--state-deg: latitude 8.5456 longitude 47.3977 is more than"))
      << swapped;
  EXPECT_NE(refusal(plane_at(47.3977, 8.5456), {97.0, 8.0, 0.0}), "accepted");
}

TEST(EarthText, IsToTheCentimetreAndATenthOfADegree) {
  EXPECT_EQ(earth_text({47.39800123, 8.5, 359.97}), "47.3980012, 8.5, course 0.0 deg");
  EXPECT_EQ(earth_text({-0.00000001, 8.5, 90.04}), "0, 8.5, course 90.0 deg");
  EXPECT_EQ(lat_lon_text({8.5, 47.25}, 7), "[47.25, 8.5]");
}

}  // namespace
}  // namespace fairway
