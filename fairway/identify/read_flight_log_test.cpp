#include "fairway/identify/read_flight_log.hpp"

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/identify/flown_track.hpp"
#include "fairway/identify/log_troubles.hpp"
#include "fairway/identify/testing/made_log.hpp"

namespace fairway {
namespace {

using testing::HasSubstr;

/// A file that is removed afterwards.
class LogFile {
 public:
  explicit LogFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("fairway_log_{}.csv", static_cast<const void*>(this))) {
    std::ofstream(path_) << text;
  }
  ~LogFile() { std::filesystem::remove(path_); }
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;
  std::string name() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

using Change = std::function<void(std::size_t, LogSample&)>;

std::string csv_of(const FlightLog& log, const std::string& header, const Change& change) {
  std::string text = header + "\n";
  for (std::size_t i = 0; i < log.samples.size(); ++i) {
    LogSample s = log.samples[i];
    change(i, s);
    text += fmt::format("{},{},{},{},{}\n", s.time_s, s.place_m.x, s.place_m.y, s.course.rad(),
                        s.command.rad());
  }
  return text;
}

const std::string simple = "t_s,x_m,y_m,course_rad,command_rad";

std::string error_of(const std::string& text, const LogFormat& format = {}) {
  const LogFile file(text);
  try {
    static_cast<void>(read_flight_log(file.name(), format));
  } catch (const InputError& error) {
    return std::string(error.what()).substr(file.name().size());
  }
  return "";
}

const auto unchanged = [](std::size_t, LogSample&) {};

TEST(ReadFlightLog, TheSimpleColumnsAreReadAsTheyAre) {
  const FlightLog made = made_log({}, 30.0, 1);
  const LogFile file(csv_of(made, simple, unchanged));
  const FlightLog log = read_flight_log(file.name(), {});
  ASSERT_EQ(log.samples.size(), made.samples.size());
  EXPECT_EQ(log.samples[100].place_m, made.samples[100].place_m);
  EXPECT_EQ(log.samples[100].course, made.samples[100].course);
  EXPECT_EQ(log.samples[100].line, 102U);
}

TEST(ReadFlightLog, AnglesFromNorthMeanTheSameFlight) {
  const FlightLog made = made_log({}, 30.0, 2);
  const auto north = [](std::size_t, LogSample& s) {
    s.course = Heading::from_rad(0.5 * pi - s.course.rad());
    s.command = Heading::from_rad(0.5 * pi - s.command.rad());
  };
  const LogFile file(csv_of(made, "t_s,x_east_m,y_north_m,course_rad,command_rad", north));
  const FlightLog log = read_flight_log(file.name(), {});
  for (std::size_t i = 0; i < made.samples.size(); ++i) {
    EXPECT_NEAR(log.samples[i].course.turn_to(made.samples[i].course), 0.0, 1e-9);
    EXPECT_NEAR(log.samples[i].command.turn_to(made.samples[i].command), 0.0, 1e-9);
  }
}

TEST(ReadFlightLog, ColumnsOfOtherNamesAreNamed) {
  const FlightLog made = made_log({}, 30.0, 3);
  const std::string text = csv_of(made, "sec,e,n,cog,cmd", unchanged);
  EXPECT_THAT(error_of(text), HasSubstr("no column t_s among sec,e,n,cog,cmd"));
  LogFormat format;
  format.columns = log_columns_of("time=sec,x=e,y=n,course=cog,command=cmd", "--columns");
  EXPECT_EQ(error_of(text, format), "");
  EXPECT_THROW(static_cast<void>(log_columns_of("tme=sec", "--columns")), InputError);
}

TEST(ReadFlightLog, WhatCannotBeALogIsRefusedWithItsLine) {
  const FlightLog made = made_log({}, 60.0, 4);
  const auto text = [&](const Change& change) { return csv_of(made, simple, change); };
  EXPECT_THAT(error_of(text([](std::size_t i, LogSample& s) {
                if (i >= 300) s.time_s += 4.0;
              })),
              HasSubstr(":302: a gap of 4.1 s"));
  EXPECT_THAT(error_of(text([](std::size_t i, LogSample& s) {
                if (i >= 300) s.time_s -= 4.0;
              })),
              HasSubstr(":302: time goes from"));
  EXPECT_THAT(error_of(text([](std::size_t i, LogSample& s) {
                if (i >= 300) s.place_m.x += 500.0;
              })),
              HasSubstr(":302: the place jumps by"));
  EXPECT_THAT(error_of(simple + "\n0,0,0,90,90\n"),
              HasSubstr(":2: course_rad is 90: expected radians"));
  EXPECT_THAT(error_of(simple + "\n0,0,0,0,0\n1,20,0,0,0\n"),
              HasSubstr(": 2 samples: expected at least"));
  EXPECT_THAT(error_of(""), HasSubstr("is empty"));
}

TEST(ReadFlightLog, CoursesCountedTheOtherWayAreNoticed) {
  const FlightLog made = made_log({}, 60.0, 5);
  const std::string text = csv_of(made, simple, unchanged);
  LogFormat format;
  format.angles = LogAngles::north_cw_rad;
  EXPECT_THAT(error_of(text, format), HasSubstr("they fit if angles are counted the other way"));
}

TEST(LogTroubles, ALogThatNeverTurnsSaysNothingOfTheRadius) {
  MadeVehicle v;
  v.most_turn_rad = 0.001;
  const FlightLog log = made_log(v, 60.0, 6);
  const double radius_m = turn_radius_flown_m(flown_track(log, 10.0));
  EXPECT_TRUE(std::isinf(radius_m));
  EXPECT_THROW(require_turns(log, radius_m), InputError);
  EXPECT_NO_THROW(require_turns(made_log({}, 60.0, 6), 60.0));
}

TEST(LogTroubles, SamplesFartherApartThanAThirdOfTheRadiusAreRefused) {
  MadeVehicle v;
  v.period_s = 2.0;
  const FlightLog log = made_log(v, 300.0, 7);
  EXPECT_THROW(require_fine(log, 60.0), InputError);
  EXPECT_NO_THROW(require_fine(log, 300.0));
}

}  // namespace
}  // namespace fairway
