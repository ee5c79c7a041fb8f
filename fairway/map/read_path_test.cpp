#include "fairway/map/read_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "fairway/map/read_map.hpp"
#include "fairway/map/tangent_plane.hpp"
#include "fairway/map/testing/scratch_folder.hpp"

namespace fairway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr GeodeticPoint zurich{47.3977, 8.5456};

class ReadPath : public ::testing::Test {
 protected:
  ReadPath() {
    plain_.grid = {100, 50, -10.0, -5.0, 1.0};
    plain_.obstacle.resize(plain_.grid.size());
    geographic_ = plain_;
    geographic_.frame.geo = GeoReference{zurich.latitude_deg, zurich.longitude_deg, 0.0};
  }
  std::vector<Vec2> read(const std::string& text, const std::string& name = "line.csv",
                         bool closed = false) {
    return read_path(folder_.write(name, text), plain_, closed);
  }
  std::string error(const std::string& text, const std::string& name = "line.csv") {
    return input_error_of([&] { (void)read(text, name); });
  }
  ScratchFolder folder_;
  ObstacleMap plain_;
  ObstacleMap geographic_;
};

TEST_F(ReadPath, HeadersAndSeparatorsFoundInPracticeAreRead) {
  const std::vector<Vec2> expected = {{1.5, 2.0}, {30.0, -4.0}};
  for (const char* text : {
           "1.5,2\n30,-4\n",                             // no header
           "x_m,y_m\n1.5,2\n30,-4\n",                    // as documented
           "\xef\xbb\xbfx_m,y_m\r\n1.5,2\r\n30,-4\r\n",  // from a spreadsheet
           "\"x_m\", \"y_m\"\n1.5, 2\n30, -4",           // quoted
           "y_m,x_m\n2,1.5\n-4,30\n",                    // in any order
           "# x_m, y_m, w_tr_right_m, w_tr_left_m\n1.5, 2, 1, 1\n30, -4, 1, 1\n",
           "# 8288b625\n# s_m; x_m; y_m; psi_rad\n0; 1.5; 2; 0\n1; 30; -4; 0\n",
           "x y\n1.5 2\n30 -4\n", "1.5\t2\n\n30\t-4\n# the end\n",
           "1.5;2\n1.5;2\n30;-4\n30;-4\n",  // repeated vertices
       })
    EXPECT_EQ(read(text), expected) << text;
}

TEST_F(ReadPath, AnyPathWrittenIsReadBack) {
  EXPECT_TRUE(rc::check([&] {
    const auto points = *rc::gen::container<std::vector<std::pair<int, int>>>(
        rc::gen::pair(rc::gen::inRange(-1000, 8999), rc::gen::inRange(-500, 4499)));
    std::vector<Vec2> expected;
    std::string text = "x_m,y_m\n";
    double low = 1e9, high = -1e9;
    for (const auto& [x, y] : points) {
      const Vec2 p{x / 100.0, y / 100.0};
      if (expected.empty() || !(expected.back() == p)) expected.push_back(p);
      text += std::to_string(p.x) + "," + std::to_string(p.y) + "\n";
      low = std::min(low, p.x);
      high = std::max(high, p.x);
    }
    RC_PRE(high - low >= 1.0);
    RC_ASSERT(read(text) == expected);
  }));
}

TEST_F(ReadPath, AClosedPathDropsARepeatedFirstVertex) {
  const std::string text = "0,0\n10,0\n10,10\n0,0\n";
  EXPECT_EQ(read(text).size(), 4U);
  EXPECT_EQ(read(text, "line.csv", true).size(), 3U);
}

TEST_F(ReadPath, WhatIsWrongIsNamedWithItsLine) {
  EXPECT_EQ(error(""), "line.csv: has no vertices, expected at least two");
  EXPECT_EQ(error("x_m,y_m\n1,2\n3,nan\n"), "line.csv:3: \"nan\" is not finite");
  EXPECT_EQ(error("x_m,y_m\n1,2\n3,1e999\n"), "line.csv:3: \"1e999\" is not finite");
  EXPECT_EQ(error("x_m,y_m\n1,2\n3,four\n"), "line.csv:3: \"four\" is not a number");
  EXPECT_EQ(error("x_m,y_m\n1,2\n3\n"), "line.csv:3: has 1 columns, expected 2");
  EXPECT_EQ(error("x_m,y_m\n1,2\n3,4,5\n"), "line.csv:3: has 3 columns, expected 2");
  EXPECT_EQ(error("speed,time\n1,2\n3,4\n"),
            "line.csv:1: the header \"speed,time\" has no columns x_m and y_m");
  EXPECT_EQ(
      error("0,0\n20,0\n95,0\n"),
      "line.csv:3: vertex 2 (95, 0) is outside the map, expected x in [-10, 90] and y in [-5, 45]");
  EXPECT_EQ(input_error_of([&] { (void)read_path(folder_.file("none.csv"), plain_); }),
            "none.csv: no such file");
}

TEST_F(ReadPath, APathWithoutLengthIsRefusedWhereItEnds) {
  const std::string what =
      ": the path has no length: every vertex is (1, 2), expected at least two "
      "distinct vertices";
  EXPECT_EQ(error("x_m,y_m\n1,2\n"), "line.csv:2" + what);
  EXPECT_EQ(error("1,2\n1,2\n\n1,2\n"), "line.csv:4" + what);
  EXPECT_EQ(error(R"({"type":"LineString","coordinates":[[1,2],[1,2]]})", "a.geojson"),
            "a.geojson: coordinates[1]" + what);
  const auto closed = [&] { (void)read("1,2\n1,2\n", "line.csv", true); };
  EXPECT_EQ(input_error_of(closed), "line.csv:2" + what);
}

TEST_F(ReadPath, DegreesInsteadOfMetresAreRefused) {
  EXPECT_EQ(error("lat,lon\n47.39,8.54\n47.40,8.55\n"),
            "line.csv: is in degrees, but the map is not georeferenced; expected x_m "
            "and y_m in the map's metres");
  EXPECT_EQ(error("8.54,30.39\n8.55,30.40\n"),
            "line.csv: the path spans 0.01 m, less than a cell of 1 m; are these degrees instead "
            "of metres?");
}

TEST_F(ReadPath, DegreesArePlacedOnAGeoreferencedMap) {
  const TangentPlane plane(zurich);
  const std::vector<Vec2> expected = {{0.0, 0.0}, {50.0, 20.0}, {80.0, -4.0}};
  std::string csv = "time,longitude,latitude\n";
  std::string json =
      R"({"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[)";
  std::string wpl = "QGC WPL 110\n0\t1\t0\t16\t0\t0\t0\t0\t47.0\t8.0\t400\t1\n";
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const GeodeticPoint p = plane.from_plane(expected[i]);
    char text[200];
    std::snprintf(text, sizeof text, "0,%.12f,%.12f\n", p.longitude_deg, p.latitude_deg);
    csv += text;
    std::snprintf(text, sizeof text, "%s[%.12f,%.12f,50]", i == 0 ? "" : ",", p.longitude_deg,
                  p.latitude_deg);
    json += text;
    std::snprintf(text, sizeof text, "%zu\t0\t3\t16\t0\t0\t0\t0\t%.12f\t%.12f\t50\t1\n", i + 1,
                  p.latitude_deg, p.longitude_deg);
    wpl += text;
  }
  json += "]}}";
  wpl += "4\t0\t3\t177\t1\t-1\t0\t0\t0\t0\t0\t1\n";  // a jump has no position
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"a.csv", csv},
                                   {"a.geojson", json},
                                   {"a.waypoints", wpl}}) {
    const auto path = read_path(folder_.write(name, text), geographic_);
    ASSERT_EQ(path.size(), expected.size()) << name;
    for (std::size_t i = 0; i < path.size(); ++i) EXPECT_LT(norm(path[i] - expected[i]), 1e-5);
  }
}

TEST_F(ReadPath, GeoJsonIsInMetresOnAMapWithoutDegrees) {
  EXPECT_THAT(read(R"({"type":"LineString","coordinates":[[0,0],[50,20]]})", "a.geojson"),
              ElementsAre(Vec2{0, 0}, Vec2{50, 20}));
  EXPECT_EQ(error(R"({"type":"LineString","coordinates":[[0,0],[500,20]]})", "a.geojson"),
            "a.geojson: coordinates[1]: vertex 1 (500, 20) is outside the map, expected x in "
            "[-10, 90] and y in [-5, 45]");
  EXPECT_EQ(error(R"({"type":"LineString","coordinates":[[0,0],[null,20]]})", "a.geojson"),
            "a.geojson: coordinates[1][0]: is null, expected a number");
  EXPECT_EQ(error(R"({"type":"Point","coordinates":[0,0]})", "a.geojson"),
            "a.geojson: has 0 LineStrings, expected one");
}

TEST_F(ReadPath, ALineCutAtTheAntimeridianIsOneLine) {
  ObstacleMap map;
  map.grid = {400, 400, -2000.0, -2000.0, 10.0};
  map.frame.geo = GeoReference{-17.0, 179.999, 0.0};
  const auto read_parts = [&](const std::string& parts) {
    return read_path(
        folder_.write("a.geojson", R"({"type":"MultiLineString","coordinates":)" + parts + "}"),
        map);
  };
  const auto path =
      read_parts("[[[179.995,-17],[180,-17.001]],[[-180,-17.001],[-179.998,-17.002]]]");
  ASSERT_EQ(path.size(), 3U);
  EXPECT_LT(path[0].x, path[1].x);
  EXPECT_LT(path[1].x, path[2].x);
  EXPECT_LT(path[2].x - path[0].x, 800.0);
  EXPECT_EQ(input_error_of([&] {
              (void)read_parts("[[[179.995,-17],[179.999,-17]],[[-180,-17],[-179.998,-17]]]");
            }),
            "a.geojson: has 2 LineStrings, expected one");
}

TEST_F(ReadPath, APlansMissionIsAPath) {
  const std::string text = R"({"fileType":"Plan","mission":{"items":[
    {"type":"SimpleItem","command":22,"frame":3,"params":[15,0,0,null,47.3977,8.5456,50]},
    {"type":"SimpleItem","command":206,"frame":2,"params":[0,0,0,0,0,0,0]},
    {"type":"ComplexItem","complexItemType":"survey","TransectStyleComplexItem":{"Items":[
      {"type":"SimpleItem","command":16,"frame":3,"params":[0,0,0,null,47.39775,8.5458,50]}]}},
    {"type":"ComplexItem","complexItemType":"fwLandingPattern",
      "landingApproachCoordinate":[47.3978,8.5459,40],"landCoordinate":[47.3979,8.5460,0]}]}})";
  EXPECT_EQ(read_path(folder_.write("a.plan", text), geographic_).size(), 4U);
  EXPECT_THAT(error(text, "a.plan"), HasSubstr("is in degrees, but the map"));
}

}  // namespace
}  // namespace fairway
