#include "fairway/report/draw_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/report/flight_series.hpp"
#include "fairway/report/testing/reading_pictures.hpp"

namespace fairway {
namespace {

using testing::elements_of_layer;
using testing::has_layer;
using testing::has_text;

TEST(DrawChart, SeriesGetLayersNamesAndTheStylesOfThePaperInTurn) {
  std::vector<ChartSeries> series;
  for (const char* name : {"one", "two", "three"})
    series.push_back({name, {0.0, 1.0, 2.0}, {0.0, 1.0, 0.5}, {}});
  const Picture picture =
      draw_chart(series, {.title = "T", .x_label = "time (s)", .y_label = "heading (rad)"});
  for (const char* text : {"T", "time (s)", "heading (rad)", "one", "two", "three"})
    EXPECT_TRUE(has_text(picture.svg, text)) << text;
  const auto dash = [&](const char* layer) {
    const auto line = elements_of_layer(picture.svg, layer).at(0).attributes;
    return line.contains("stroke-dasharray") ? line.at("stroke-dasharray") : "";
  };
  EXPECT_EQ(dash("series-1"), "");
  EXPECT_NE(dash("series-2"), "");
  EXPECT_NE(dash("series-3"), "");
  EXPECT_NE(dash("series-2"), dash("series-3"));
  series[1].style = LineStyle::solid;
  EXPECT_EQ(elements_of_layer(draw_chart(series, {}).svg, "series-2")
                .at(0)
                .attributes.contains("stroke-dasharray"),
            false);
}

TEST(DrawChart, PointsThatAreNotFiniteBreakTheLine) {
  const std::vector<ChartSeries> series{
      {"gap", {0.0, 1.0, 2.0, 3.0, 4.0}, {1.0, 2.0, std::nan(""), 2.0, 1.0}, {}}};
  const std::string data =
      elements_of_layer(draw_chart(series, {}).svg, "series-1").at(0).attributes.at("d");
  EXPECT_EQ(std::count(data.begin(), data.end(), 'M'), 2);
  EXPECT_EQ(std::count(data.begin(), data.end(), 'L'), 2);
}

TEST(DrawChart, AnAxisFromZeroStartsAtZero) {
  const std::vector<ChartSeries> series{{"d", {0.0, 1.0}, {50.0, 60.0}, {}}};
  EXPECT_TRUE(has_text(draw_chart(series, {.y_from_zero = true}).svg, "0"));
  EXPECT_TRUE(has_text(draw_chart(series, {.y_from_zero = true}).svg, "20"));
  EXPECT_FALSE(has_text(draw_chart(series, {}).svg, "20"));
}

RC_GTEST_PROP(DrawChart, AnyNumbersGiveAChart, (std::uint64_t seed)) {
  Random random(seed);
  std::vector<ChartSeries> series(random.below(4));
  for (auto& s : series)
    for (std::uint64_t i = 0, n = random.below(5); i < n; ++i) {
      const auto number = [&] {
        const std::array odd{0.0, 1.0, -1e300, 1e300, 1e-300, HUGE_VAL, std::nan("")};
        return random.below(2) == 0 ? odd[random.below(odd.size())] : random.uniform(-9.0, 9.0);
      };
      s.x.push_back(number());
      s.y.push_back(number());
    }
  const Picture picture = draw_chart(series, {.title = "any", .y_from_zero = random.below(2) == 0});
  RC_ASSERT(has_layer(picture.svg, "axes"));
  RC_ASSERT(picture.svg.find("nan") == std::string::npos);
  RC_ASSERT(picture.svg.find("inf") == std::string::npos);
}

TEST(DrawChart, CallerMistakesAreReported) {
  const std::vector<ChartSeries> uneven{{"u", {0.0, 1.0}, {0.0}, {}}};
  EXPECT_THROW(static_cast<void>(draw_chart(uneven, {})), PreconditionViolation);
  EXPECT_THROW(static_cast<void>(draw_chart({}, {.width_pt = 1.0})), PreconditionViolation);
}

/// Straight on, then twice round to the left, at 10 m/s with a radius of 20 m.
Flight twice_round() {
  Flight flight;
  flight.start = {{0.0, 0.0}, Heading::from_rad(3.0)};
  flight.segments.push_back({flight.start, 0.0, 10.0, 0.0});
  State here{10.0 * flight.start.heading.unit(), flight.start.heading};
  double time_s = 1.0;
  for (int i = 0; i < 8; ++i) {  // eight quarter turns
    flight.segments.push_back({here, time_s, 10.0 * pi, 0.05});
    const Vec2 left = left_of(here.heading.unit());
    here.position_m = here.position_m + 20.0 * (left + here.heading.unit());
    here.heading = Heading::from_rad(here.heading.rad() + 0.5 * pi);
    time_s += pi;
  }
  return flight;
}

TEST(FlightSeries, HeadingsOverTimeDoNotJumpByATurn) {
  const ChartSeries series = heading_over_time(twice_round(), 10.0, "h");
  EXPECT_DOUBLE_EQ(series.y.front(), 3.0);
  EXPECT_NEAR(series.y.back(), 3.0 + 4.0 * pi, 1e-9);
  EXPECT_NEAR(series.x.back(), 1.0 + 8.0 * pi, 1e-9);
  for (std::size_t i = 1; i < series.x.size(); ++i)
    EXPECT_LE(std::abs(series.y[i] - series.y[i - 1]),
              0.5 * (series.x[i] - series.x[i - 1]) + 1e-9);  // v / r = 0.5 rad/s
}

TEST(FlightSeries, HeadingsWithin180DegreesBreakWhereTheyWrap) {
  const ChartSeries whole = heading_over_time(twice_round(), 10.0, "h");
  const ChartSeries wrapped = wrapped_degrees(whole);
  std::size_t breaks = 0;
  for (std::size_t i = 0; i < wrapped.y.size(); ++i) {
    if (std::isnan(wrapped.y[i])) {
      ++breaks;
      EXPECT_EQ(wrapped.y[i - 1], 180.0);  // turning left, up and out at the top
      EXPECT_EQ(wrapped.y[i + 1], -180.0);
      continue;
    }
    EXPECT_GE(wrapped.y[i], -180.0);
    EXPECT_LE(wrapped.y[i], 180.0);
    if (i == 0 || std::isnan(wrapped.y[i - 1])) continue;
    EXPECT_NEAR(wrapped.y[i] - wrapped.y[i - 1],  // v / r = 0.5 rad/s once it turns
                wrapped.x[i - 1] < 1.0 - 1e-9 ? 0.0 : 90.0 / pi * (wrapped.x[i] - wrapped.x[i - 1]),
                1e-6);
  }
  EXPECT_EQ(breaks, 2U);  // 172 degrees and two turns more
  const ChartSeries turns{"t", {0.0, 4.0, 5.0}, {0.0, -4.0 * pi, pi}, {}};
  const ChartSeries many = wrapped_degrees(turns);  // two and a half turns within a piece
  EXPECT_EQ(std::count_if(many.y.begin(), many.y.end(), [](double y) { return std::isnan(y); }), 4);
  EXPECT_EQ(many.y.back(), 180.0);
}

TEST(FlightSeries, DistancesFromAPathAreThoseOfTheCircle) {
  // A circle of 20 m about (10, 30), and a path along the x axis: between 10 and 50 m away.
  Flight flight;
  flight.start = {{10.0, 10.0}, Heading()};
  flight.segments.push_back({flight.start, 0.0, 40.0 * pi, 0.05});
  const PathMission path{{{-1000.0, 0.0}, {1000.0, 0.0}}, false};
  const ChartSeries series = path_distance_over_time(flight, 10.0, path, 1.0, "d");
  ASSERT_GT(series.x.size(), 120U);
  for (std::size_t i = 0; i < series.x.size(); ++i)
    EXPECT_NEAR(series.y[i], 30.0 - 20.0 * std::cos(series.x[i] * 0.5), 1e-9);
  EXPECT_NEAR(series.x.back(), 4.0 * pi, 1e-9);
}

TEST(FlightSeries, AnUnrecordedFlightGivesAnEmptySeries) {
  EXPECT_TRUE(heading_over_time(Flight{}, 10.0, "h").x.empty());
  EXPECT_THROW(static_cast<void>(heading_over_time(Flight{}, 0.0, "h")), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
