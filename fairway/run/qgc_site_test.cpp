#include "fairway/run/qgc_site.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/exchange/qgc_mission.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/map/testing/scratch_folder.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

constexpr const char* site_text = R"({"fileType": "Plan", "version": 1,
 "geoFence": {"version": 2, "circles": [{"version": 1, "inclusion": false,
   "circle": {"center": [47.401, 8.545], "radius": 40.5}}],
   "polygons": [{"version": 1, "inclusion": true, "polygon":
   [[47.393, 8.5397], [47.393, 8.5603], [47.407, 8.5603], [47.407, 8.5397]]}]},
 "rallyPoints": {"version": 2, "points": [[47.4, 8.55, 60]]},
 "mission": {"version": 2, "items": [], "plannedHomePosition": [47.4, 8.55, 408]}})";

class Site : public ::testing::Test {
 protected:
  fs::path file(const char* name, const std::string& text = site_text) {
    fs::create_directories(folder_.file(name).parent_path());
    std::ofstream(folder_.file(name)) << text;
    return folder_.file(name);
  }
  /// Of a plan made from a scenario next to `map`.
  PlanRecord record(const fs::path& map, const Mission& mission) {
    PlanRecord record;
    record.mission = mission;
    record.inputs = {{"site.toml", "0"}, {map.filename().string(), sha256_file(map)}};
    return record;
  }
  ScratchFolder folder_;
  const Mission goal_ = GoalMission{{0.0, 0.0}, {}};
};

TEST_F(Site, KeepsFenceRallyPointsAndHomeAltitude) {
  const QgcSite site = qgc_site_of(file("site.plan"));
  const auto source = nlohmann::json::parse(site_text);
  EXPECT_EQ(nlohmann::json::parse(site.fence_json), source["geoFence"]);
  EXPECT_EQ(nlohmann::json::parse(site.rally_points_json), source["rallyPoints"]);
  EXPECT_EQ(site.home_altitude_m, 408.0);
  Flight flight;
  flight.segments = {{flight.start, 0.0, 100.0, 0.0}};
  const LonLatOf somewhere = [](Vec2 p) { return LonLat{8.55 + 1e-5 * p.x, 47.4 + 1e-5 * p.y}; };
  const auto mission =
      nlohmann::json::parse(qgc_plan_text(flight, 10.0, somewhere, {50.0, 1.0, site}));
  EXPECT_EQ(mission["geoFence"], source["geoFence"]);
  EXPECT_EQ(mission["rallyPoints"], source["rallyPoints"]);
  EXPECT_EQ(mission["mission"]["plannedHomePosition"][2], 408.0);
  const auto bare = nlohmann::json::parse(qgc_plan_text(flight, 10.0, somewhere, {}));
  EXPECT_TRUE(bare["geoFence"]["polygons"].empty());
  EXPECT_EQ(bare["mission"]["plannedHomePosition"][2], 0.0);
}

TEST_F(Site, IsFoundByItsDigestBesideThePlanOrAboveIt) {
  const PlanRecord of_site = record(file("site.plan"), goal_);
  fs::create_directories(folder_.file("out/run"));
  for (const fs::path& folder : {folder_.file(""), folder_.file("out"), folder_.file("out/run")}) {
    EXPECT_TRUE(qgc_site_of(of_site, folder).has_value()) << folder;
  }
  const fs::path here = fs::current_path();
  fs::current_path(folder_.file("out"));
  EXPECT_TRUE(qgc_site_of(of_site, "").has_value());  // a plan file's name without a folder
  fs::current_path(here);
  file("site.plan", std::string(site_text) + "\n");  // another file by now
  EXPECT_FALSE(qgc_site_of(of_site, folder_.file("")).has_value());
  EXPECT_NE(no_fence_warning(of_site, "--fence FILE").find("site.plan"), std::string::npos);
}

TEST_F(Site, IsNotTakenFromThePathOfAMission) {
  const fs::path line = file("line.plan");
  const PathMission path{{{0.0, 0.0}, {1.0, 0.0}}, false};
  EXPECT_FALSE(qgc_site_of(record(line, path), folder_.file("")).has_value());
  PlanRecord with_map = record(file("site.plan"), path);
  with_map.inputs->push_back({"line.plan", sha256_file(line)});
  EXPECT_TRUE(qgc_site_of(with_map, folder_.file("")).has_value());
  EXPECT_FALSE(qgc_site_of(PlanRecord{}, folder_.file("")).has_value());
  EXPECT_EQ(no_fence_warning(PlanRecord{}, "--fence FILE").find("not found"), std::string::npos);
}

TEST_F(Site, RefusesWhatIsNotAPlan) {
  EXPECT_THROW((void)qgc_site_of(file("a.plan", "{\"a\": 1}")), InputError);
  EXPECT_THROW((void)qgc_site_of(file("b.plan", "no JSON")), InputError);
  EXPECT_THROW((void)qgc_site_of(folder_.file("none.plan")), InputError);
}

}  // namespace
}  // namespace fairway
