// What goes out to GIS programs and autopilots reads back as what it was.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/exchange/plan_rasters.hpp"
#include "fairway/exchange/qgc_mission.hpp"
#include "fairway/exchange/track.hpp"
#include "fairway/field/direction_field.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/map/frame_from_degrees.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/map/read_path.hpp"
#include "fairway/map/testing/reading_rasters.hpp"
#include "fairway/map/testing/scratch_folder.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/run/plan_map.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/start_states.hpp"

namespace fairway {
namespace {

constexpr GeoReference somewhere{47.4, 8.55, 0.001};

/// 60 by 44 cells with a wall and walled-off corner, so that every kind of cell is there.
ObstacleMap walled(const std::optional<GeoReference>& geo) {
  ObstacleMap map;
  map.grid = {60, 44, -120.0, -80.0, 4.0};
  map.obstacle.assign(map.grid.size(), 0);
  for (int ix = 20; ix < 34; ++ix) map.obstacle[map.grid.index({ix, 20})] = 1;
  for (int i = 0; i <= 12; ++i) {
    map.obstacle[map.grid.index({i, 12})] = 1;
    map.obstacle[map.grid.index({12, i})] = 1;
  }
  map.frame.geo = geo;
  return map;
}

Plan plan_on(const ObstacleMap& map) {
  auto answer = plan_map(map, {10.0, 8.0}, GoalMission{{60.0, 50.0}, {}}, {});
  return std::get<Plan>(std::move(answer));
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

class Exchange : public ::testing::Test {
 protected:
  ScratchFolder folder_;
};

TEST_F(Exchange, APlanReadsBackFromItsRasterBitForBit) {
  const Plan plan = plan_on(walled(somewhere));
  write_plan_raster(plan, folder_.file("p.tif"), Existing::keep);
  const std::vector<ReadBand> bands = bands_of(folder_.file("p.tif"), plan.grid);
  ASSERT_EQ(bands.size(), 3U);
  EXPECT_TRUE(same_bits(bands[0].values, plan.heading_rad));
  const std::vector<float>& cost = bands[1].values;
  const std::vector<float>& region = bands[2].values;
  std::size_t unreachable = 0;
  for (std::size_t i = 0; i < cost.size(); ++i) {
    EXPECT_EQ(region[i], static_cast<float>(plan.region[i]));
    if (std::isfinite(plan.cost_m[i])) {
      EXPECT_EQ(cost[i], plan.cost_m[i]);
    } else {
      EXPECT_TRUE(std::isnan(cost[i]));
      ++unreachable;
    }
  }
  EXPECT_GT(unreachable, 0U);
}

TEST_F(Exchange, ACertificateKnowsWhereItsPlanLiesAndReadsBack) {
  const Plan plan = plan_on(walled(somewhere));
  CertifyOptions options;
  options.undecided_max = 0.5;
  options.samples = 1000;
  const Verification made = verify_plan(plan, "plan", {}, options);
  EXPECT_EQ(made.certificate.frame, plan.record.frame);
  EXPECT_EQ(made.certificate.frame->geo, somewhere);

  const std::vector<Heading> headings = even_headings(3);
  write_verdict_raster(plan.grid, *made.certificate.frame,
                       verdict_layers(made.certificate, headings), folder_.file("v.tif"),
                       Existing::keep);
  const std::vector<ReadBand> bands = bands_of(folder_.file("v.tif"), plan.grid);
  ASSERT_EQ(bands.size(), 3U);
  std::array<std::size_t, verdict_count> seen{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<float>& found = bands[k].values;
    const auto expected = verdicts_at(made.certificate, headings[k]);
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i], static_cast<float>(expected[i]));
      ++seen[static_cast<std::size_t>(expected[i])];
    }
  }
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::reach)], 0U);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::collide)], 0U);
  EXPECT_EQ(bands[1].name, "verdict at heading 2.0944 rad");
}

TEST_F(Exchange, VerdictsAtAHeadingAreQueriesOfItsStates) {
  const Plan plan = plan_on(walled({}));
  CertifyOptions options;
  options.undecided_max = 0.5;
  options.samples = 1000;
  const Certificate certificate = verify_plan(plan, "plan", {}, options).certificate;
  const auto verdicts = verdicts_at(certificate, Heading::from_rad(1.0));
  const auto answers = ask(certificate, states_asked_at(plan.grid, Heading::from_rad(1.0)));
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    EXPECT_EQ(verdicts[i], answers[i].verdict);
    if (plan.region[i] == Region::obstacle) {
      EXPECT_EQ(verdicts[i], Verdict::collide);
    }
    if (plan.region[i] == Region::goal) {
      EXPECT_EQ(verdicts[i], Verdict::reach);
    }
    const Vec2 asked = states_asked_at(plan.grid, Heading::from_rad(1.0))[i].position_m;
    EXPECT_EQ(plan.grid.index(plan.grid.cell_of(asked)), i);
    if (i == 100) break;  // the places are alike
  }
}

/// With further modes in eight directions.
Plan plan_with_modes() {
  Plan plan = plan_on(walled({}));
  for (int k = 0; k < 8; ++k) {
    const double direction_rad = two_pi * k / 8;
    const auto field = direction_field(plan.grid, plan.region, direction_rad, 16.0);
    plan.mode_heading_rad.insert(plan.mode_heading_rad.end(), field.begin(), field.end());
    plan.record.modes.push_back({"direction", direction_rad});
  }
  return plan;
}

TEST_F(Exchange, CommandsOfFurtherModesAreBandsAfterThePlansOwn) {
  const Plan plan = plan_with_modes();
  write_plan_raster(plan, folder_.file("p.tif"), Existing::keep);
  const std::vector<ReadBand> bands = bands_of(folder_.file("p.tif"), plan.grid);
  ASSERT_EQ(bands.size(), 3U + 8U);
  EXPECT_TRUE(same_bits(bands[0].values, plan.heading_rad));
  for (std::size_t k = 0; k < 8; ++k) {
    const float* field = plan.further_rad()[k];
    EXPECT_TRUE(same_bits(bands[3 + k].values, {field, field + plan.grid.size()}));
  }
  EXPECT_EQ(bands[3].name, "heading_rad of mode 1");
}

TEST_F(Exchange, TheModesThatServeAreBandsAfterTheVerdicts) {
  const Plan plan = plan_with_modes();
  CertifyOptions options;
  options.undecided_max = 0.1;
  options.samples = 1000;
  const Certificate certificate = verify_plan(plan, "plan", {}, options).certificate;
  ASSERT_EQ(certificate.further_modes(), 8);
  const std::vector<Heading> headings = even_headings(4);
  write_verdict_raster(plan.grid, {}, verdict_layers(certificate, headings), folder_.file("v.tif"),
                       Existing::keep);
  const std::vector<ReadBand> bands = bands_of(folder_.file("v.tif"), plan.grid);
  ASSERT_EQ(bands.size(), 8U);
  EXPECT_EQ(bands[4].name, "mode at heading 0 rad");
  std::size_t by_further = 0;
  for (std::size_t h = 0; h < 4; ++h) {
    const auto answers = ask(certificate, states_asked_at(plan.grid, headings[h]));
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const bool reaches = answers[i].verdict == Verdict::reach;
      ASSERT_EQ(bands[h].values[i], static_cast<float>(answers[i].verdict));
      ASSERT_EQ(bands[4 + h].values[i], reaches ? static_cast<float>(answers[i].mode) : 255.0F);
      by_further += answers[i].mode > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(by_further, 0U);
}

TEST_F(Exchange, MissionsReadBackAsLinesWithinTheToleranceOfTheFlight) {
  const ObstacleMap map = walled(somewhere);
  const Plan plan = plan_on(map);
  const LonLatOf lon_lat = lon_lat_of(frame_in(plan.record), "plan");
  const ExactFlights flights(plan);
  const double speed_mps = plan.vehicle.speed_mps;
  int read_back = 0;
  for (const State& start : random_states(plan, StartRegion::safe_start, 20, 4)) {
    const Flight flight = flights.record(start);
    const QgcMissionOptions options{80.0, 0.5};
    const auto expected = thinned_track(flight, speed_mps, options.tolerance_m);
    if (expected.size() < 2 ||
        norm(expected.back().state.position_m - start.position_m) < map.grid.cell_m) {
      continue;  // too short to be read as a path
    }
    for (const bool as_plan : {true, false}) {
      const std::string text = as_plan ? qgc_plan_text(flight, speed_mps, lon_lat, options)
                                       : qgc_waypoints_text(flight, speed_mps, lon_lat, options);
      const auto file = folder_.write(as_plan ? "m.plan" : "m.waypoints", text);
      const std::vector<Vec2> back = read_path(file, map, false);
      ASSERT_EQ(back.size(), expected.size());
      ++read_back;
      for (std::size_t i = 0; i < back.size(); ++i) {
        EXPECT_LT(norm(back[i] - expected[i].state.position_m), 2e-4);
      }
    }
  }
  EXPECT_GE(read_back, 30);
}

TEST_F(Exchange, AMissionHasThePartsThatGroundStationsAskFor) {
  const Plan plan = plan_on(walled(somewhere));
  const Flight flight = ExactFlights(plan).record({{-100.0, 60.0}, Heading::from_rad(0.0)});
  const LonLatOf lon_lat = lon_lat_of(frame_in(plan.record), "plan");
  const auto mission = nlohmann::json::parse(qgc_plan_text(flight, 10.0, lon_lat, {35.0, 1.0}));
  EXPECT_EQ(mission["fileType"], "Plan");
  EXPECT_EQ(mission["version"], 1);
  EXPECT_EQ(mission["geoFence"]["version"], 2);
  EXPECT_EQ(mission["rallyPoints"]["version"], 2);
  EXPECT_EQ(mission["mission"]["version"], 2);
  EXPECT_EQ(mission["mission"]["cruiseSpeed"], 10.0);
  const auto& items = mission["mission"]["items"];
  ASSERT_GE(items.size(), 3U);
  EXPECT_EQ(items[0]["command"], 178);
  EXPECT_EQ(items[0]["params"][1], 10.0);
  for (std::size_t i = 0; i < items.size(); ++i) {
    EXPECT_EQ(items[i]["doJumpId"], i + 1);
    EXPECT_EQ(items[i]["params"].size(), 7U);
    if (i == 0) continue;
    EXPECT_EQ(items[i]["command"], 16);
    EXPECT_EQ(items[i]["frame"], 3);
    EXPECT_EQ(items[i]["params"][6], 35.0);
  }
  EXPECT_EQ(mission["mission"]["plannedHomePosition"][0], items[1]["params"][4]);
  // An altitude of its own and a wider tolerance: fewer points.
  const auto coarse = nlohmann::json::parse(qgc_plan_text(flight, 10.0, lon_lat, {0.0, 20.0}));
  EXPECT_LT(coarse["mission"]["items"].size(), items.size());
  EXPECT_THROW((void)qgc_plan_text(flight, 10.0, {}, {}), PreconditionViolation);
  EXPECT_THROW((void)qgc_plan_text(flight, 10.0, lon_lat, {-1.0, 1.0}), PreconditionViolation);
  EXPECT_THROW((void)qgc_waypoints_text(flight, 10.0, lon_lat, {1.0, 0.0}), PreconditionViolation);
}

TEST_F(Exchange, AMissionOfAFlightThatDoesNotReachIsWarnedOf) {
  Flight flight;
  flight.result = {Outcome::reach, 10.0, 40.0};
  EXPECT_TRUE(mission_warnings(std::vector{flight}).empty());
  flight.result.outcome = Outcome::collide;
  EXPECT_EQ(mission_warnings(std::vector{flight}),
            std::vector<std::string>{
                "the flight collides after 10.00 s, and the mission leads there too."});
  flight.result.outcome = Outcome::leave;
  EXPECT_EQ(mission_warnings(std::vector{flight}).size(), 1U);
  constexpr double never = std::numeric_limits<double>::infinity();
  flight.result = {Outcome::trapped, never, never};
  EXPECT_EQ(mission_warnings(std::vector{flight}).size(), 1U);
}

TEST_F(Exchange, AProjectedPlanHasDegreesAndAPlanOfNowhereHasNone) {
  ObstacleMap map = walled({});
  EXPECT_FALSE(lon_lat_of(map.frame, "plan"));
  map.frame.projected_crs = wkt_of_epsg(32632);
  map.grid.x0_m += 600000.0;
  map.grid.y0_m += 5200000.0;
  const LonLat place = lon_lat_of(map.frame, "plan")({600000.0, 5200000.0});
  EXPECT_NEAR(place.longitude_deg, 10.3, 0.1);  // 100 km east of the zone's meridian, 9 degrees
  const Vec2 back =
      FrameFromDegrees(map, "path").point_m("path", {place.latitude_deg, place.longitude_deg});
  EXPECT_LT(norm(back - Vec2{600000.0, 5200000.0}), 1e-4);
}

}  // namespace
}  // namespace fairway
