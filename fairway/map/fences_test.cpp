// GeoJSON, QGroundControl plans, ArduPilot fences and waypoint files: what they mean on the ground.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fairway/base/heading.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/map/tangent_plane.hpp"
#include "fairway/map/testing/scratch_folder.hpp"

namespace fairway {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr GeodeticPoint zurich{47.3977, 8.5456};

class Fences : public ::testing::Test {
 protected:
  // Degrees of a point given in metres about Zurich.
  static GeodeticPoint at(double x_m, double y_m) {
    return TangentPlane(zurich).from_plane({x_m, y_m});
  }
  static std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.12f", value);
    return text;
  }
  static std::string lon_lat(double x_m, double y_m) {
    const GeodeticPoint p = at(x_m, y_m);
    return "[" + number(p.longitude_deg) + "," + number(p.latitude_deg) + "]";
  }
  static std::string lat_lon(double x_m, double y_m) {
    const GeodeticPoint p = at(x_m, y_m);
    return "[" + number(p.latitude_deg) + "," + number(p.longitude_deg) + "]";
  }
  // A square ring in GeoJSON's order, closed.
  static std::string square(double x_m, double y_m, double half_m) {
    return "[" + lon_lat(x_m - half_m, y_m - half_m) + "," + lon_lat(x_m + half_m, y_m - half_m) +
           "," + lon_lat(x_m + half_m, y_m + half_m) + "," + lon_lat(x_m - half_m, y_m + half_m) +
           "," + lon_lat(x_m - half_m, y_m - half_m) + "]";
  }
  static std::string feature(const std::string& geometry, const std::string& properties = "null") {
    return R"({"type":"Feature","properties":)" + properties + R"(,"geometry":)" + geometry + "}";
  }
  static std::string collection(const std::string& features) {
    return R"({"type":"FeatureCollection","features":[)" + features + "]}";
  }
  static std::string polygon(const std::string& rings) {
    return R"({"type":"Polygon","coordinates":[)" + rings + "]}";
  }
  static std::string plan(const std::string& polygons, const std::string& circles = "",
                          const std::string& items = "") {
    return R"({"fileType":"Plan","version":1,"groundStation":"x","geoFence":{"version":2,"polygons":[)" +
           polygons + R"(],"circles":[)" + circles +
           R"(]},"mission":{"version":2,"plannedHomePosition":[47.3977,8.5456,400],"items":[)" +
           items + "]}}";
  }
  static std::string plan_square(double x_m, double y_m, double half_m, bool keep_in) {
    return std::string(R"({"version":1,"inclusion":)") + (keep_in ? "true" : "false") +
           R"(,"polygon":[)" + lat_lon(x_m - half_m, y_m - half_m) + "," +
           lat_lon(x_m + half_m, y_m - half_m) + "," + lat_lon(x_m + half_m, y_m + half_m) + "," +
           lat_lon(x_m - half_m, y_m + half_m) + "]}";
  }

  MapRequest request(const std::string& name, const std::string& text) {
    MapRequest request;
    request.file = folder_.write(name, text);
    request.cell_m = 2.0;
    request.reference = zurich;
    return request;
  }
  ObstacleMap read(const std::string& name, const std::string& text) {
    return read_map(request(name, text));
  }
  std::string error(const std::string& name, const std::string& text) {
    return input_error_of([&] { (void)read(name, text); });
  }
  static bool blocked(const ObstacleMap& map, Vec2 p) {
    const Cell cell = map.grid.cell_of(p);
    EXPECT_TRUE(map.grid.contains(cell));
    return map.obstacle[map.grid.index(cell)] != 0;
  }

  ScratchFolder folder_;
};

TEST_F(Fences, GeoJsonPolygonsAreObstaclesWithHoles) {
  const ObstacleMap map =
      read("a.geojson", collection(feature(polygon(square(0, 0, 40) + "," + square(0, 0, 20)))));
  EXPECT_TRUE(blocked(map, {30, 0}));
  EXPECT_TRUE(blocked(map, {0, -30}));
  EXPECT_FALSE(blocked(map, {0, 0}));
  EXPECT_FALSE(blocked(map, {15, 15}));
  EXPECT_FALSE(blocked(map, {45, 45}));
  ASSERT_TRUE(map.frame.geo.has_value());
  EXPECT_EQ(map.frame.geo->latitude_deg, zurich.latitude_deg);
  EXPECT_EQ(map.frame.geo->longitude_deg, zurich.longitude_deg);
}

TEST_F(Fences, EveryKindOfGeoJsonDocumentIsRead) {
  const std::string bare = polygon(square(0, 0, 40));
  const std::string multi = R"({"type":"MultiPolygon","coordinates":[[)" + square(0, 0, 40) + "]]}";
  const std::string gathered = R"({"type":"GeometryCollection","geometries":[)" + bare + "]}";
  const auto expected = read("a.geojson", bare).obstacle;
  for (const auto& text : {feature(bare), collection(feature(bare)), multi, gathered,
                           collection(feature("null") + "," + feature(multi))})
    EXPECT_EQ(read("a.geojson", text).obstacle, expected) << text;
  EXPECT_EQ(read("a.json", bare).obstacle, expected);
}

TEST_F(Fences, PointsWithARadiusAreRoundAndOthersAreWarnedAbout) {
  const std::string point = R"({"type":"Point","coordinates":)" + lon_lat(10, 0) + "}";
  const ObstacleMap map =
      read("a.geojson", collection(feature(point, R"({"radius_m":20})") + "," + feature(point)));
  EXPECT_TRUE(blocked(map, {28, 0}));
  EXPECT_FALSE(blocked(map, {28, 18}));
  EXPECT_THAT(map.warnings, ::testing::ElementsAre(HasSubstr("1 points without radius_m")));
  EXPECT_THAT(error("a.geojson", feature(point, R"({"radius_m":-1})")),
              HasSubstr("the radius is -1, expected metres above 0"));
}

TEST_F(Fences, GeoJsonInclusionMakesAKeepInFence) {
  const ObstacleMap map =
      read("a.geojson", collection(feature(polygon(square(0, 0, 40)), R"({"inclusion":true})") +
                                   "," + feature(polygon(square(10, 0, 5)))));
  EXPECT_FALSE(blocked(map, {-20, 0}));
  EXPECT_TRUE(blocked(map, {10, 0}));
  EXPECT_NEAR(map.grid.width_m(), 84.0, 2.1) << "the world is the fence's box and the ring";
}

TEST_F(Fences, HeightsBelowTheAltitudeAreFreeAndUnknownHeightsAreNot) {
  const std::string text =
      collection(feature(polygon(square(-30, 0, 5)), R"({"HEIGHT":12.5})") + "," +
                 feature(polygon(square(0, 0, 5)), R"({"HEIGHT":null})") + "," +
                 feature(polygon(square(30, 0, 5)), R"({"HEIGHT":30})"));
  MapRequest request = this->request("a.geojson", text);
  EXPECT_TRUE(blocked(read_map(request), {-30, 0}));
  request.altitude_m = 20.0;
  const ObstacleMap map = read_map(request);
  EXPECT_FALSE(blocked(map, {-30, 0}));
  EXPECT_TRUE(blocked(map, {0, 0}));
  EXPECT_TRUE(blocked(map, {30, 0}));
  request.margin_m = 10.0;
  EXPECT_TRUE(blocked(read_map(request), {-30, 0}));
}

TEST_F(Fences, ImpossibleHeightsStayObstacles) {
  for (const char* none : {"-9999", "-32768", "-3.4e38", "-20000"}) {
    MapRequest request = this->request(
        "a.geojson",
        collection(feature(polygon(square(-30, 0, 5)), R"({"height":)" + std::string(none) + "}") +
                   "," + feature(polygon(square(30, 0, 5)), R"({"height":3})")));
    request.altitude_m = 20.0;
    const ObstacleMap map = read_map(request);
    EXPECT_TRUE(blocked(map, {-30, 0})) << none;
    EXPECT_FALSE(blocked(map, {30, 0}));
    EXPECT_THAT(map.warnings, ::testing::Contains(HasSubstr("1 features have impossible heights")));
  }
}

TEST_F(Fences, AFootprintGrowsObstacles) {
  MapRequest request = this->request("a.geojson", polygon(square(0, 0, 10)));
  request.footprint_radius_m = 15.0;
  const ObstacleMap map = read_map(request);
  EXPECT_TRUE(blocked(map, {24, 0}));
  EXPECT_FALSE(blocked(map, {28, 0}));
  EXPECT_TRUE(blocked(map, {19, 19})) << "corners grow round";
  EXPECT_FALSE(blocked(map, {24, 24}));
}

TEST_F(Fences, APlanKeepsInAndOut) {
  const ObstacleMap map =
      read("a.plan", plan(plan_square(0, 0, 50, true) + "," + plan_square(20, 0, 5, false),
                          R"({"version":1,"inclusion":false,"circle":{"center":)" +
                              lat_lon(-20, 0) + R"(,"radius":8}})"));
  EXPECT_FALSE(blocked(map, {0, 0}));
  EXPECT_TRUE(blocked(map, {20, 0}));
  EXPECT_TRUE(blocked(map, {-27, 0}));
  EXPECT_FALSE(blocked(map, {-31, 0}));
  EXPECT_NEAR(map.grid.x0_m, -52.0, 0.01);
}

TEST_F(Fences, SeveralKeepInFencesNeedInclusion) {
  const std::string text = plan(plan_square(-20, 0, 40, true) + "," + plan_square(20, 0, 40, true));
  EXPECT_EQ(
      error("a.plan", text),
      "a.plan: has 2 keep-in fences; map.inclusion is missing: \"all\" (stay in every one) or "
      "\"any\" (stay in one of them)");
  MapRequest request = this->request("a.plan", text);
  request.inclusion = Inclusion::all;
  const ObstacleMap all = read_map(request);
  EXPECT_NEAR(all.grid.width_m(), 44.0, 2.1);
  EXPECT_FALSE(blocked(all, {0, 0}));
  request.inclusion = Inclusion::any;
  const ObstacleMap any = read_map(request);
  EXPECT_FALSE(blocked(any, {-55, 0}));
  EXPECT_FALSE(blocked(any, {0, 0}));
  EXPECT_FALSE(blocked(any, {20, 0})) << "no wall where one fence ends inside the other";
}

TEST_F(Fences, AMissionWithoutFencesIsAnOpenWorldAroundIt) {
  const auto item = [&](double x_m, double y_m) {
    const GeodeticPoint p = at(x_m, y_m);
    return R"({"type":"SimpleItem","command":16,"frame":3,"params":[0,0,0,null,)" +
           number(p.latitude_deg) + "," + number(p.longitude_deg) + ",50]}";
  };
  const std::string text = plan("", "", item(0, 0) + "," + item(100, 0) + R"(,
      {"type":"SimpleItem","command":20,"frame":2,"params":[0,0,0,null,null,null,0]})");
  MapRequest request = this->request("a.plan", text);
  request.outside_is_obstacle = false;
  const ObstacleMap map = read_map(request);
  EXPECT_NEAR(map.grid.x0_m, -20.0, 0.01);
  EXPECT_NEAR(map.grid.width_m(), 140.0, 2.1);
  EXPECT_EQ(std::count(map.obstacle.begin(), map.obstacle.end(), 1), 0);
}

TEST_F(Fences, TheReferenceIsTheRequestsElseHomeElseTheMiddle) {
  MapRequest request = this->request("a.plan", plan(plan_square(100, 0, 40, true)));
  request.reference.reset();
  EXPECT_EQ(read_map(request).frame.geo->latitude_deg, 47.3977);
  request = this->request("a.geojson", polygon(square(100, 0, 40)));
  request.reference.reset();
  const ObstacleMap map = read_map(request);
  const GeodeticPoint middle = at(100, 0);
  EXPECT_NEAR(map.frame.geo->latitude_deg, middle.latitude_deg, 1e-7);
  EXPECT_NEAR(map.frame.geo->longitude_deg, middle.longitude_deg, 1e-7);
}

TEST_F(Fences, AHomeFarAwayIsNotTheOrigin) {
  std::string text = plan(plan_square(0, 0, 40, true));
  text.replace(text.find("[47.3977,8.5456,400]"), 20, "[-35.0,149.0,400]");
  MapRequest request = this->request("a.plan", text);
  request.reference.reset();
  const ObstacleMap map = read_map(request);
  EXPECT_NEAR(map.frame.geo->latitude_deg, zurich.latitude_deg, 1e-6);
  EXPECT_THAT(map.warnings, ::testing::ElementsAre(HasSubstr("more than 100 km")));
}

TEST_F(Fences, PolygonsThatCrossThemselvesAreRefusedWithTheCrossingNamed) {
  EXPECT_EQ(error("a.geojson", polygon("[[8.0,47.0],[8.1,47.1],[8.1,47.0],[8.0,47.1],[8.0,47.0]]")),
            "a.geojson: coordinates: the polygon crosses or touches itself: edge 0 (vertex 0 to 1) "
            "meets edge 2 (vertex 2 to 3) at latitude 47.0500000, longitude 8.0500000");
  EXPECT_EQ(error("a.fence", "47.0 8.0\n47.0 8.0\n47.1 8.1\n47.0 8.1\n47.1 8.0\n47.0 8.0\n"),
            "a.fence: the polygon crosses or touches itself: the edge from line 2 to line 3 meets "
            "the edge from line 4 to line 5 at latitude 47.0500000, longitude 8.0500000");
}

TEST_F(Fences, WrongGeoJsonIsReportedWithItsLocation) {
  const auto ring_error = [&](const std::string& ring) {
    return error("a.geojson", collection(feature(polygon(ring))));
  };
  EXPECT_EQ(ring_error("[[8,47],[8.1,47],[8.1,47.1],[8,47.1]]"),
            "a.geojson: features[0].geometry.coordinates[0]: is not closed: the last position "
            "differs from the first");
  EXPECT_EQ(
      ring_error("[[8,47],[8.1,47],[8,47]]"),
      "a.geojson: features[0].geometry.coordinates[0]: has 3 positions, a ring needs at least "
      "4 (the last equal to the first)");
  EXPECT_EQ(ring_error("[[8,47],[8.1,null],[8.1,47.1],[8,47]]"),
            "a.geojson: features[0].geometry.coordinates[0][1][1]: is null, expected a number");
  EXPECT_EQ(ring_error("[[8],[8.1,47],[8.1,47.1],[8,47]]"),
            "a.geojson: features[0].geometry.coordinates[0][0]: is too short, expected [longitude, "
            "latitude]");
  EXPECT_EQ(ring_error("[[321498,4298018],[321500,4298018],[321500,4298020],[321498,4298018]]"),
            "a.geojson: features[0].geometry.coordinates[0][0]: latitude 4298018 is out of range, "
            "expected degrees from -90 to 90");
  EXPECT_EQ(
      ring_error("[[8,47],[8,47],[8.1,47],[8,47]]"),
      "a.geojson: features[0].geometry.coordinates: ring 0 has 2 different vertices, expected "
      "at least 3");
  EXPECT_THAT(ring_error("[[8,47],[12,47],[12,47.1],[8,47]]"), HasSubstr("km from the reference"));
  EXPECT_THAT(ring_error("[[-179,47],[179,47],[179,47.1],[-179,47]]"), HasSubstr("antimeridian"));
  EXPECT_EQ(error("a.geojson", collection("")),
            "a.geojson: has no fence, obstacle or mission item");
  EXPECT_EQ(error("a.geojson", R"({"type":"Blob"})"),
            "a.geojson: type: is \"Blob\", expected a GeoJSON geometry");
  EXPECT_EQ(error("a.geojson", "{}"), "a.geojson: is not GeoJSON, the key \"type\" is missing");
  EXPECT_THAT(error("a.geojson", "{\n\"type\": \"Polygon\",\n oops}"),
              StartsWith("a.geojson:3: is not JSON: syntax error"));
  EXPECT_EQ(error("a.geojson", R"({"type":"Polygon","type":"Point"})"),
            "a.geojson: has the key \"type\" twice in one object");
  EXPECT_THAT(error("a.geojson", std::string(100000, '[')),
              HasSubstr("nests more than 64 levels of JSON"));
  EXPECT_THAT(error("a.geojson", R"({"type":"Point","coordinates":[1e999,0]})"),
              HasSubstr("is not JSON: "));
  EXPECT_THAT(
      error(
          "a.geojson",
          R"({"type":"FeatureCollection","features":[],"crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}}})"),
      AllOf(HasSubstr("EPSG::25832"), HasSubstr("ogr2ogr")));
}

TEST_F(Fences, AWrongPlanIsReportedWithItsLocation) {
  EXPECT_EQ(error("a.plan", R"({"fileType":"Plan","geoFence":{"version":1}})"),
            "a.plan: geoFence.version: is not 2; open and save the plan with a current "
            "QGroundControl");
  EXPECT_EQ(error("a.plan", plan(R"({"polygon":[]})")),
            "a.plan: geoFence.polygons[0]: the key \"inclusion\" is missing");
  EXPECT_EQ(error("a.plan", plan(R"({"inclusion":1,"polygon":[]})")),
            "a.plan: geoFence.polygons[0].inclusion: is a number, expected true or false");
  EXPECT_EQ(error("a.plan", plan("", R"({"inclusion":true,"circle":{"center":[47,8]}})")),
            "a.plan: geoFence.circles[0].circle: the key \"radius\" is missing");
  EXPECT_EQ(error("a.plan", plan("", "", R"({"type":"SimpleItem","command":16,"params":[0]})")),
            "a.plan: mission.items[0].params: has 1 elements, expected 7");
  EXPECT_EQ(
      error("a.plan", plan("", "", R"({"type":"SimpleItem","command":1e300,"params":[0]})")),
      "a.plan: mission.items[0].command: is 1e+300, expected a whole number from -1000000000 to "
      "1000000000");
  EXPECT_EQ(
      error("a.plan", plan("", "", R"({"type":"ComplexItem","complexItemType":"StructureScan"})")),
      "a.plan: mission.items[0]: is a complex item of kind \"StructureScan\" without plain "
      "waypoints");
  EXPECT_EQ(error("a.plan", plan("")), "a.plan: has no fence, obstacle or mission item");
}

TEST_F(Fences, AnArduPilotFenceIsAKeepInRingAboutItsReturnPoint) {
  const auto line = [&](double x_m, double y_m) {
    const GeodeticPoint p = at(x_m, y_m);
    return number(p.latitude_deg) + "\t" + number(p.longitude_deg) + "\n";
  };
  const std::string ring = line(-50, -50) + line(50, -50) + line(50, 50) + line(-50, 50);
  MapRequest request = this->request("a.txt", "# saved\n" + line(0, 0) + ring + line(-50, -50));
  request.reference.reset();
  const ObstacleMap map = read_map(request);
  EXPECT_NEAR(map.grid.x0_m, -52.0, 0.01);
  EXPECT_FALSE(blocked(map, {0, 0}));
  EXPECT_FALSE(blocked(map, {45, 45}));
  EXPECT_NEAR(map.frame.geo->latitude_deg, zurich.latitude_deg, 1e-9);

  EXPECT_EQ(error("a.txt", line(0, 0) + ring),
            "a.txt:5: the ring is not closed: the last point differs from the first corner in line "
            "2");
  EXPECT_EQ(
      error("a.txt", line(0, 0) + line(1, 1)),
      "a.txt: has 2 points, expected a return point and a closed ring with at least 3 corners "
      "(5 lines)");
  EXPECT_EQ(error("a.txt", "47.0 8.0\n47.0\n"),
            "a.txt:2: \"47.0\" has 1 values, expected latitude and longitude");
  EXPECT_EQ(error("a.txt", "47.0 east\n"), "a.txt:1: \"east\" is not a number");
  EXPECT_EQ(error("a.txt", "147.0 8.0\n"),
            "a.txt:1: latitude 147 is out of range, expected degrees from -90 to 90");
  EXPECT_EQ(error("a.txt", "nan 8.0\n"),
            "a.txt:1: latitude nan is out of range, expected degrees from -90 to 90");
}

TEST_F(Fences, AWaypointFileMayHoldFences) {
  const auto row = [&](int index, int command, double parameter, double x_m, double y_m) {
    const GeodeticPoint p = at(x_m, y_m);
    return std::to_string(index) + "\t0\t3\t" + std::to_string(command) + "\t" + number(parameter) +
           "\t0\t0\t0\t" + number(p.latitude_deg) + "\t" + number(p.longitude_deg) + "\t50\t1\r\n";
  };
  const std::string head = "QGC WPL 110\r\n" + row(0, 16, 0, 0, 0);
  const std::string text = head + row(1, 5001, 4, -50, -50) + row(2, 5001, 4, 50, -50) +
                           row(3, 5001, 4, 50, 50) + row(4, 5001, 4, -50, 50) +
                           row(5, 5004, 10, 20, 0);
  const ObstacleMap map = read("a.waypoints", text);
  EXPECT_FALSE(blocked(map, {-20, 0}));
  EXPECT_TRUE(blocked(map, {25, 0}));
  EXPECT_EQ(error("a.txt", head + row(1, 5001, 4, 0, 0) + row(2, 16, 0, 1, 1)),
            "a.txt:4: the polygon that starts at a.txt:3 has 1 corners, expected 4");
  EXPECT_EQ(error("a.txt", head + row(1, 5002, 2, 0, 0)),
            "a.txt:3: the polygon has 2 corners, expected at least 3");
  EXPECT_EQ(error("a.txt", "QGC WPL 120\n"),
            "a.txt:1: \"QGC WPL 120\" is not a waypoint file, expected \"QGC WPL 110\"");
  EXPECT_EQ(error("a.txt", "QGC WPL 110\n1 2 3\n"), "a.txt:2: has 3 fields, expected 12");
  EXPECT_EQ(error("a.txt", "QGC WPL 110\n0 0 x 16 0 0 0 0 47 8 0 1\n"),
            "a.txt:2: field 3 is \"x\", expected a number");
}

TEST_F(Fences, WithoutAKeepInFenceTheWorldHoldsTheMission) {
  folder_.write("out.geojson", feature(polygon(square(0, 0, 50))));
  MapRequest request;
  request.file = folder_.file("out.geojson");
  request.cell_m = 10.0;
  request.world_margin_m = 30.0;
  request.outside_is_obstacle = false;
  const auto holds = [](const Grid& g, Vec2 p, double room_m) {
    return p.x - room_m >= g.x0_m - 0.5 && p.x + room_m <= g.x0_m + g.width_m() + 0.5 &&
           p.y - room_m >= g.y0_m - 0.5 && p.y + room_m <= g.y0_m + g.height_m() + 0.5;
  };
  const Grid alone = read_map(request).grid;
  EXPECT_FALSE(holds(alone, {600, 0}, 0));
  request.also_hold_m = {{600, -20}};
  request.also_hold_deg = {at(-30, 700)};
  request.also_hold_path = folder_.write("p.csv", "x_m,y_m\n0,0\n-900,10\n");
  const ObstacleMap map = read_map(request);
  for (const Vec2 p : {Vec2{600, -20}, Vec2{-30, 700}, Vec2{-900, 10}})
    EXPECT_TRUE(holds(map.grid, p, 30.0)) << p.x << " " << p.y;
  EXPECT_NEAR(map.frame.geo->latitude_deg, 47.3977, 1e-6) << "the plane stays with the file";
  EXPECT_GE(map.frame.geo->worst_error_m, TangentPlane(at(0, 0)).worst_error_m(at(-900, 10)));
  // Places on another continent, or unreadable ones, are reported by the reader of the mission.
  request.also_hold_m = {{1e7, 0}};
  request.also_hold_deg = {{-33.0, 151.0}};
  request.also_hold_path = folder_.file("none.csv");
  EXPECT_EQ(read_map(request).grid, alone);
  // A keep-in fence bounds the world.
  folder_.write("in.geojson", feature(polygon(square(0, 0, 200)), R"({"inclusion":true})"));
  request.file = folder_.file("in.geojson");
  request.also_hold_m = {{600, 0}};
  EXPECT_FALSE(holds(read_map(request).grid, {600, 0}, 0));
}

TEST_F(Fences, ErrorsSayTheScenariosLineToo) {
  MapRequest request;
  request.place_of = [](std::string_view key) {
    return key == "map.file" ? std::string("s.toml:2") : "s.toml:3";
  };
  const auto error = [&] { return input_error_of([&] { (void)read_map(request); }); };
  request.file = folder_.file("gone.geojson");
  EXPECT_EQ(error(), "gone.geojson: no such file (map.file of s.toml:2)");
  request.file = folder_.write("a.geojson", "{\n]");
  EXPECT_THAT(error(), AllOf(StartsWith("a.geojson:2: is not JSON"), HasSubstr("of s.toml:2)")));
  request.file = folder_.write("b.geojson", feature(polygon(square(0, 0, 5000))));
  request.cell_m = 1e-3;
  EXPECT_THAT(error(), StartsWith("s.toml:3: map.cell_m: 0.001 m cells on a map of 1"));
}

TEST_F(Fences, OtherFairwayFilesAreIdentified) {
  MapRequest request;
  request.file = folder_.write("s.toml", "[map]\nfile = \"a\"\n[mission]\nkind = \"goal\"\n");
  EXPECT_EQ(input_error_of([&] { (void)read_map(request); }),
            "s.toml: is a scenario: `fairway plan` makes a plan from it");
}

TEST_F(Fences, FilesOfNoKnownKindAreRefused) {
  EXPECT_THAT(
      error("a.xyz", "hello"),
      StartsWith(
          "a.xyz: has an unrecognised format; expected ROS map_server .yaml, QGC waypoints, "));
}

}  // namespace
}  // namespace fairway
