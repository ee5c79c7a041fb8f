#include "fairway/exchange/flight_files.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fairway/base/random.hpp"
#include "fairway/simulate/state_files.hpp"

namespace fairway {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A quarter circle to the left of radius 10 from (1, 2) heading east, then 5 m north.
Flight quarter_and_straight() {
  Flight flight;
  flight.start = {{1.0, 2.0}, Heading::from_rad(0.0)};
  const double arc_m = 10.0 * pi / 2;
  flight.result = {Outcome::reach, (arc_m + 5.0) / 4.0, arc_m + 5.0};
  flight.segments = {{flight.start, 0.0, arc_m, 0.1},
                     {{{11.0, 12.0}, Heading::from_rad(pi / 2)}, arc_m / 4.0, 5.0, 0.0}};
  return flight;
}

TEST(FlightFiles, WritesALinePerStartThatReadsBackAsTheSameDoubles) {
  Random random(3);
  std::vector<State> starts;
  std::vector<FlightResult> results;
  for (int i = 0; i < 200; ++i) {
    starts.push_back(
        {{random.uniform(-1e6, 1e6), random.normal()}, Heading::from_rad(random.uniform(-pi, pi))});
    const Outcome outcome =
        outcomes_in_order[static_cast<std::size_t>(i) % outcomes_in_order.size()];
    const bool ends = outcome != Outcome::trapped && outcome != Outcome::hold;
    results.push_back({outcome, ends ? random.unit() : infinity, 0.1});
  }
  std::vector<FlightMeasures> measures(starts.size());
  for (FlightMeasures& m : measures) m.turning = {120.5, 3.25, 7, 1.0};
  const std::string text = outcomes_csv(starts, results, measures, false);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "x_m,y_m,heading_rad,outcome,time_s,length_m,flown_m,reversals,turned_rad");
  EXPECT_EQ(states_of_csv(text, "outcomes"), starts);
  EXPECT_NE(text.find(",trapped,inf,0.1,120.5,7,3.25\n"), std::string::npos);
}

TEST(FlightFiles, NamesModesInALastColumnOnlyWhenThePlanHasThem) {
  const std::vector<State> starts{{{1.0, 2.0}, {}}, {{3.0, 4.0}, {}}};
  const std::vector<FlightResult> results{{Outcome::reach, 4.0, 40.0, 3},
                                          {Outcome::collide, 6.0, 60.0, 0}};
  const std::vector<FlightMeasures> measures(2);
  EXPECT_EQ(outcomes_csv(starts, results, measures, false, true),
            "x_m,y_m,heading_rad,outcome,time_s,length_m,flown_m,reversals,turned_rad,mode\n"
            "1,2,0,reach,4,40,0,0,0,3\n"
            "3,4,0,collide,6,60,0,0,0,0\n");
  EXPECT_EQ(states_of_csv(outcomes_csv(starts, results, measures, true, true), "outcomes"), starts);
  Flight flight = quarter_and_straight();
  flight.segments[0].mode = 2;
  flight.final_leg.state = FinalLegState::shortest;
  flight.final_leg.segments = {{end_of(flight), flight.result.time_s, 4.0, 0.0}};
  const std::vector<Flight> flights{flight};
  const std::string text = trajectories_csv(flights, 4.0, 100.0, true);
  std::istringstream lines(text);
  std::string line;
  std::vector<std::string> ends;
  while (std::getline(lines, line)) ends.push_back(line.substr(line.find_last_of(',')));
  EXPECT_EQ(ends, (std::vector<std::string>{",mode", ",2", ",2", ",0", ",0", ",", ","}));
  // Without the column: what is written of a flight that has no modes, to the byte.
  std::istringstream again(text);
  std::string without;
  while (std::getline(again, line)) without += line.substr(0, line.find_last_of(',')) + '\n';
  EXPECT_EQ(trajectories_csv(flights, 4.0, 100.0), without);
}

TEST(FlightFiles, SaysWhatCameAfterThePathWasReached) {
  const std::vector<State> starts{{{1.0, 2.0}, {}}, {{3.0, 4.0}, {}}, {{5.0, 6.0}, {}}};
  const std::vector<FlightResult> results{
      {Outcome::reach, 4.0, 40.0}, {Outcome::reach, 5.0, 50.0}, {Outcome::collide, 6.0, 60.0}};
  std::vector<FlightMeasures> measures(3);
  measures[0].onward = {After::collide, 9.5, 95.0};
  measures[0].following = {3.5, 6.0, 0.75, 1.5, 2.5, 0.25, 0.5, 0.125};
  measures[1].onward = {After::follow, 8.0, 80.0};  // and never on the path within both deltas
  const std::string text = outcomes_csv(starts, results, measures, true);
  EXPECT_EQ(
      text,
      "x_m,y_m,heading_rad,outcome,time_s,length_m,flown_m,reversals,turned_rad,after,after_s,"
      "joined_s,laps,on_path_share,distance_mean_m,distance_worst_m,"
      "heading_difference_worst_rad\n"
      "1,2,0,reach,4,40,0,0,0,collide,9.5,3.5,0.125,0.75,1.5,2.5,0.5\n"
      "3,4,0,reach,5,50,0,0,0,follow,8,,,,,,\n"
      "5,6,0,collide,6,60,0,0,0,,,,,,,,\n");
  EXPECT_EQ(states_of_csv(text, "outcomes"), starts);
  Flight flight = quarter_and_straight();
  flight.onward = measures[0].onward;
  const auto json = nlohmann::json::parse(flights_geojson(std::vector{flight}, 1.0));
  const auto& properties = json["features"][0]["properties"];
  EXPECT_EQ(properties["outcome"], "reach");
  EXPECT_EQ(properties["after"], "collide");
  EXPECT_EQ(properties["after_s"], 9.5);
  EXPECT_EQ(properties["after_length_m"], 95.0);
}

TEST(FlightFiles, SamplesTrajectoriesNoFartherApartThanAsked) {
  const std::vector<Flight> flights{quarter_and_straight()};
  std::istringstream lines(trajectories_csv(flights, 4.0, 1.0));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "flight,time_s,x_m,y_m,heading_rad,curvature_per_m,final_leg");
  double last_s = 0.0;
  double x = 0.0;
  double y = 0.0;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    double flight = 0.0;
    double time_s = 0.0;
    double heading_rad = 0.0;
    double curvature = 0.0;
    char comma = 0;
    fields >> flight >> comma >> time_s >> comma >> x >> comma >> y >> comma >> heading_rad >>
        comma >> curvature;
    EXPECT_LE(time_s - last_s, 0.25 + 1e-12);
    last_s = time_s;
    if (curvature != 0.0) {
      EXPECT_NEAR(std::hypot(x - 1.0, y - 12.0), 10.0, 1e-12);  // on its circle
      EXPECT_NEAR(heading_rad, time_s * 0.4, 1e-12);
    }
  }
  EXPECT_NEAR(x, 11.0, 1e-12);
  EXPECT_NEAR(y, 17.0, 1e-12);
  EXPECT_NEAR(last_s, flights[0].result.time_s, 1e-12);
}

/// The same, and then straight on for 4 m.
Flight with_final_leg() {
  Flight flight = quarter_and_straight();
  flight.final_leg.state = FinalLegState::other;
  flight.final_leg.entry = end_of(flight);
  flight.final_leg.word = "S+LSL";
  flight.final_leg.time_s = 1.0;
  flight.final_leg.length_m = 4.0;
  flight.final_leg.segments = {{end_of(flight), flight.result.time_s, 4.0, 0.0}};
  return flight;
}

TEST(FlightFiles, MarksTheFinalLegThatFollowsAFlight) {
  const Flight flight = with_final_leg();
  std::istringstream lines(trajectories_csv(std::vector{flight}, 4.0, 1.0));
  std::string line;
  std::getline(lines, line);
  int before = 0;
  int after = 0;
  std::string last;
  while (std::getline(lines, line)) {
    (line.ends_with(",1") ? after : before) += 1;
    EXPECT_TRUE(line.ends_with(after > 0 ? ",1" : ",0")) << line;  // it comes last
    last = line;
  }
  EXPECT_EQ(before, 17 + 6);
  EXPECT_EQ(after, 5);
  std::istringstream fields(last);
  double value = 0.0;
  char comma = 0;
  std::vector<double> row;
  while (fields >> value) {
    row.push_back(value);
    fields >> comma;
  }
  EXPECT_NEAR(row[1], flight.result.time_s + 1.0, 1e-12);
  EXPECT_NEAR(row[3], 21.0, 1e-12);
}

TEST(FlightFiles, GeojsonHasTheFinalLegsAfterAllFlights) {
  Flight refused = quarter_and_straight();
  refused.final_leg.state = FinalLegState::none_clear;
  const auto json = nlohmann::json::parse(
      flights_geojson(std::vector{with_final_leg(), refused, quarter_and_straight()}, 1.0));
  const auto& features = json["features"];
  ASSERT_EQ(features.size(), 4U);
  EXPECT_EQ(features[0]["properties"]["final_leg"], "other");
  EXPECT_EQ(features[1]["properties"]["final_leg"], "none_clear");
  EXPECT_FALSE(features[2]["properties"].contains("final_leg"));
  EXPECT_EQ(features[3]["properties"], (nlohmann::json{{"flight", 0},
                                                       {"final_leg", "other"},
                                                       {"word", "S+LSL"},
                                                       {"time_s", 1.0},
                                                       {"length_m", 4.0}}));
  EXPECT_EQ(features[3]["geometry"]["coordinates"], (nlohmann::json{{11.0, 17.0}, {11.0, 21.0}}));
}

TEST(FlightFiles, WritesGeojsonThatParsesInMetresAndInDegrees) {
  Flight trapped = quarter_and_straight();
  trapped.result = {Outcome::trapped, infinity, infinity};
  Flight at_once;
  at_once.start = {{7.0, 8.0}, Heading::from_rad(0.0)};
  at_once.result = {Outcome::collide, 0.0, 0.0};
  const std::vector<Flight> flights{quarter_and_straight(), trapped, at_once};

  const auto metres = nlohmann::json::parse(flights_geojson(flights, 1.0));
  EXPECT_EQ(metres["type"], "FeatureCollection");
  EXPECT_TRUE(metres.contains("note"));
  ASSERT_EQ(metres["features"].size(), 3U);
  const auto& first = metres["features"][0];
  EXPECT_EQ(first["properties"]["outcome"], "reach");
  EXPECT_EQ(first["properties"]["length_m"], flights[0].result.length_m);
  EXPECT_EQ(first["geometry"]["type"], "LineString");
  EXPECT_EQ(first["geometry"]["coordinates"].front(), (nlohmann::json{1.0, 2.0}));
  EXPECT_EQ(first["geometry"]["coordinates"].back(), (nlohmann::json{11.0, 17.0}));
  EXPECT_EQ(first["geometry"]["coordinates"].size(), 1U + 16U + 1U);
  EXPECT_TRUE(metres["features"][1]["properties"]["time_s"].is_null());
  EXPECT_EQ(metres["features"][2]["geometry"]["type"], "Point");

  const auto degrees = nlohmann::json::parse(flights_geojson(flights, 1.0, [](Vec2 p) {
    return LonLat{8.0 + p.x * 1e-5, 50.0 + p.y * 1e-5};
  }));
  EXPECT_FALSE(degrees.contains("note"));
  EXPECT_EQ(degrees["features"][0]["geometry"]["coordinates"].back(),
            (nlohmann::json{8.00011, 50.00017}));
}

TEST(FlightFiles, GeojsonIsCutAtTheAntimeridian) {
  Flight flight;
  flight.start = {{0.0, 0.0}, Heading::from_rad(0.0)};
  flight.result = {Outcome::reach, 1.0, 40.0};
  const auto straight = [](double x, double y, double length_m, double heading_rad) {
    return FlightSegment{{{x, y}, Heading::from_rad(heading_rad)}, 0.0, length_m, 0.0};
  };
  // A degree of longitude for each metre, from `west_deg` on.
  const auto geometry = [&](double west_deg, std::vector<FlightSegment> segments) {
    flight.segments = std::move(segments);
    const auto place = [&](Vec2 p) {
      const double longitude = west_deg + p.x;
      return LonLat{longitude > 180.0 ? longitude - 360.0 : longitude, p.y};
    };
    const auto json = nlohmann::json::parse(flights_geojson(std::vector{flight}, 100.0, place));
    return json["features"][0]["geometry"];
  };
  using nlohmann::json;
  EXPECT_EQ(geometry(170.0, {straight(0, 0, 5, 0)}),
            (json{{"type", "LineString"}, {"coordinates", {{170.0, 0.0}, {175.0, 0.0}}}}));
  const json across = geometry(170.0, {straight(0, 0, 20, 0), straight(20, 0, 20, pi)});
  EXPECT_EQ(across["type"], "MultiLineString");
  EXPECT_EQ(across["coordinates"], (json{{{170.0, 0.0}, {180.0, 0.0}},
                                         {{-180.0, 0.0}, {-170.0, 0.0}, {-180.0, 0.0}},
                                         {{180.0, 0.0}, {170.0, 0.0}}}));
  // Where it crosses is between its points: 20 degrees along of 30 and up.
  const json slanted = geometry(160.0, {straight(0, 0, 50, std::atan2(4, 3))});
  EXPECT_NEAR(slanted["coordinates"][0][1][1].get<double>(), 40.0 * 20.0 / 30.0, 1e-8);
  // Beginning or ending on it makes no part of one point.
  EXPECT_EQ(geometry(180.0, {straight(0, 0, 5, 0)})["coordinates"],
            (json{{-180.0, 0.0}, {-175.0, 0.0}}));
  EXPECT_EQ(geometry(170.0, {straight(0, 0, 10, 0)})["coordinates"],
            (json{{170.0, 0.0}, {180.0, 0.0}}));
  EXPECT_EQ(geometry(175.0, {straight(10, 0, 5, pi)})["coordinates"],
            (json{{-175.0, 0.0}, {-180.0, 0.0}}));
}

}  // namespace
}  // namespace fairway
