#include "fairway/simulate/state_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

using ::testing::HasSubstr;

State state(double x, double y, double heading_rad) {
  return {{x, y}, Heading::from_rad(heading_rad)};
}

std::string refusal_of(std::string_view text) {
  try {
    (void)states_of_csv(text, "s.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StateFiles, ReadsThreeColumnsWithAndWithoutAHeader) {
  const std::vector<State> expected{state(1.5, -2.0, 0.5), state(3.0, 4e2, -1.0)};
  EXPECT_EQ(states_of_csv("1.5,-2,0.5\n3,4e2,-1\n", "s.csv"), expected);
  EXPECT_EQ(states_of_csv("x_m,y_m,heading_rad\n1.5,-2,0.5\n3,4e2,-1", "s.csv"), expected);
  EXPECT_EQ(states_of_csv("\xef\xbb\xbfx_m, y_m, heading_rad\r\n\r\n 1.5, -2, 0.5 \r\n# no\r\n"
                          "+3,4e2,-1\r\n",
                          "s.csv"),
            expected);
}

TEST(StateFiles, FindsTheColumnsOfAnOutcomesFileByName) {
  const auto states =
      states_of_csv("outcome,heading_rad,y_m,x_m\nreach,0.5,-2,1.5\ncollide,-1,400,3\n", "s.csv");
  EXPECT_EQ(states, (std::vector<State>{state(1.5, -2.0, 0.5), state(3.0, 400.0, -1.0)}));
}

TEST(StateFiles, ReadsDegreesAndWraps) {
  const auto states = states_of_csv("0,0,90deg\n0,0,-90 deg\n0,0,180deg\n0,0,540deg\n0,0,7\n", "s");
  EXPECT_EQ(states[0].heading.rad(), pi / 2);
  EXPECT_EQ(states[1].heading.rad(), -pi / 2);
  EXPECT_EQ(states[2].heading.rad(), pi);
  EXPECT_EQ(states[3].heading.rad(), pi);
  EXPECT_DOUBLE_EQ(states[4].heading.rad(), 7.0 - two_pi);
}

TEST(StateFiles, SaysWhereAndWhatIsWrong) {
  EXPECT_THAT(refusal_of("1,2,3\n1,2\n"), HasSubstr("s.csv:2: 2 fields: expected 3"));
  EXPECT_THAT(refusal_of("1,2,3\n\n1,two,3\n"), HasSubstr("s.csv:3: y_m is 'two': expected"));
  EXPECT_THAT(refusal_of("1,2,nan\n"), HasSubstr("s.csv:1: heading_rad is 'nan': expected"));
  EXPECT_THAT(refusal_of("1,inf,0\n"), HasSubstr("s.csv:1: y_m is 'inf'"));
  EXPECT_THAT(refusal_of("1,2,90\n"), HasSubstr("did you mean 90deg?"));
  EXPECT_THAT(refusal_of("1,2,-7.01\n"), HasSubstr("expected radians from -7 to 7"));
  EXPECT_THAT(refusal_of("0,0,1e308\n"), testing::Not(HasSubstr("did you mean")));
  EXPECT_THAT(refusal_of("1,2,1rad\n"), HasSubstr("heading_rad is '1rad'"));
  EXPECT_THAT(refusal_of("1,2,deg\n"), HasSubstr("heading_rad is 'deg'"));
  EXPECT_THAT(refusal_of("1,2,3x\n"), HasSubstr("s.csv:1"));
  EXPECT_THAT(refusal_of("1,2,1e999\n"), HasSubstr("s.csv:1"));
  EXPECT_THAT(refusal_of("x_m,y_m\n1,2\n"), HasSubstr("s.csv:1: no column heading_rad"));
  EXPECT_THAT(refusal_of("x_m,y_m,x_m,heading_rad\n"), HasSubstr("x_m appears twice"));
  EXPECT_THAT(refusal_of("1,2,3\nx_m,y_m,heading_rad\n"), HasSubstr("s.csv:2: x_m is 'x_m'"));
  EXPECT_THAT(refusal_of(""), HasSubstr("s.csv: no states"));
  EXPECT_THAT(refusal_of("x_m,y_m,heading_rad\n"), HasSubstr("s.csv: no states"));
}

TEST(StateFiles, RefusesAFileThatIsNotThere) {
  EXPECT_THROW((void)read_states("no/such/states.csv"), InputError);
  EXPECT_THROW((void)read_states("."), InputError);
}

TEST(StateFiles, ReadsOneStateOfTheCommandLine) {
  EXPECT_EQ(state_of_text("10, 20, 90deg", "--state"), state(10.0, 20.0, pi / 2));
  EXPECT_THROW((void)state_of_text("10,20", "--state"), InputError);
}

// On a plane where a degree is a metre, and a course a heading.
State from_degrees(const EarthState& d, const std::string& where) {
  if (d.latitude_deg > 80.0) throw InputError(where, "too far north");
  return state(d.longitude_deg, d.latitude_deg, (90.0 - d.course_deg) * pi / 180.0);
}

TEST(StateFiles, ReadsStatesInDegreesWhereThereIsAWayFromDegrees) {
  const std::string text =
      "\xef\xbb\xbf# drawn\r\nlon_deg;lat_deg;course_deg;note\r\n8.5;47;90;x\r\n";
  EXPECT_EQ(states_of_csv(text, "s.csv", from_degrees),
            (std::vector<State>{state(8.5, 47.0, 0.0)}));
  EXPECT_THAT(refusal_of(text),
              HasSubstr("s.csv: is in degrees, and the map is not georeferenced"));
  // Metres go before: a file may have both.
  EXPECT_EQ(states_of_csv("lat_deg,x_m,y_m,heading_rad\n47,1,2,0.5\n", "s", from_degrees),
            (std::vector<State>{state(1.0, 2.0, 0.5)}));
  EXPECT_EQ(states_of_csv("1,2,0.5\n", "s", from_degrees),
            (std::vector<State>{state(1.0, 2.0, 0.5)}));
}

TEST(StateFiles, ErrorsInDegreesNameTheLine) {
  const auto refusal = [](const std::string& line) -> std::string {
    try {
      (void)states_of_csv("lat_deg,lon_deg,course_deg\n" + line, "s.csv", from_degrees);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal("47,8,359.9\n"), "accepted");
  EXPECT_EQ(refusal("85,8,0\n"), "s.csv:2: too far north");
  EXPECT_EQ(refusal("95,8,0\n"), "s.csv:2: lat_deg is '95': expected degrees from -90 to 90");
  EXPECT_EQ(refusal("47,181,0\n"), "s.csv:2: lon_deg is '181': expected degrees from -180 to 180");
  EXPECT_EQ(
      refusal("47,8,361\n"),
      "s.csv:2: course_deg is '361': expected degrees from -360 to 360, clockwise from north");
  EXPECT_EQ(refusal("47,8,nan\n").substr(0, 24), "s.csv:2: course_deg is '");
}

TEST(StateText, InDegreesIsLatitudeLongitudeCourse) {
  EXPECT_EQ(earth_state_of_text("47.5, -8, 270", "--state-deg"), (EarthState{47.5, -8.0, 270.0}));
  EXPECT_THROW((void)earth_state_of_text("47.5,-8", "--state-deg"), InputError);
  EXPECT_THROW((void)earth_state_of_text("147.5,-8,0", "--state-deg"), InputError);
}

}  // namespace
}  // namespace fairway
