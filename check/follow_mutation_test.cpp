// Certificates that a path is followed, made by the prover: accepted as they are, refused once
// changed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <variant>

#include "check/lap_sums.hpp"
#include "check/testing/refusal.hpp"
#include "check/testing/taken_apart.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/field/holding_circle.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/verify/testing/plans_along_paths.hpp"

namespace fairway_check {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A goal in open water, and the circle that is held there.
fairway::Plan plan_that_holds() {
  const fairway::Vec2 goal_m{108.0, 108.0};
  const fairway::Plan water = fairway::empty_plan(27, 27, 8.0, 20.0);
  fairway::Plan plan = plan_along(path_of(holding_place_at(water.grid, goal_m, water.vehicle)),
                                  water.grid.nx, water.grid.ny);
  fairway::GoalMission goal;
  goal.goal_m = goal_m;
  goal.hold = true;
  plan.record.mission = goal;
  for (float& rad : plan.heading_rad) {  // as files have them
    if (std::abs(rad) < 1e-9F) rad = 0.0F;
  }
  return plan;
}

class FollowMutation : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("fairway-follow-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    closed_ = certificate(plan_along(fairway::ellipse_to_follow(), 32, 30));
    open_ = certificate(plan_along(fairway::line_to_follow(), 30, 15));
    hold_ = certificate(plan_that_holds());
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static std::string certificate(const fairway::Plan& plan) {
    fairway::ContractVerifyOptions options;
    options.samples = 5000;
    options.find_witnesses = false;
    const auto made =
        fairway::verify_contract(plan, "plan", fairway::RegionOfInterest{},
                                 fairway::contract_to_follow(), options, [](const std::string&) {});
    EXPECT_TRUE(made.following);
    write_contract_certificate(made.certificate, folder_ / "good", fairway::Existing::replace);
    std::ifstream in(folder_ / "good", std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Of the certificate `bytes`, against the plan with another mission.
  static std::string refusal_for(const std::string& bytes, fairway::Plan plan,
                                 const fairway::Mission& mission) {
    plan.record.mission = mission;
    std::ofstream(folder_ / "kept", std::ios::binary) << bytes;
    write_plan(plan, folder_ / "plan", fairway::Existing::replace);
    return refusal_of(folder_ / "kept", folder_ / "plan", 2000);
  }
  static std::string refusal(TakenApart parts) {
    parts.sign();
    std::ofstream(folder_ / "changed", std::ios::binary) << parts.file();
    return refusal_of(folder_ / "changed", "", 2000);
  }
  static void expect_refused(const TakenApart& parts, const std::string& because) {
    EXPECT_THAT(refusal(parts), testing::HasSubstr(because));
  }
  static std::uint16_t stage_of(const TakenApart& parts, std::size_t leaf) {
    return parts.at<std::uint16_t>("leaf_stage", leaf);
  }
  static std::size_t core_leaf(const TakenApart& parts) {
    return parts.find([&](std::size_t leaf) { return stage_of(parts, leaf) != 0; });
  }

  static fs::path folder_;
  static std::string closed_;
  static std::string open_;
  static std::string hold_;
};
fs::path FollowMutation::folder_;
std::string FollowMutation::closed_;
std::string FollowMutation::open_;
std::string FollowMutation::hold_;

TEST_F(FollowMutation, WhatTheProverProvesIsAccepted) {
  EXPECT_EQ(refusal(TakenApart(closed_)), "");
  EXPECT_EQ(refusal(TakenApart(open_)), "");
  for (const std::string& file : {closed_, open_}) {
    const TakenApart parts(file);
    EXPECT_GT(parts.record["volume_fraction"]["follow"], 0.2);
  }
}

TEST_F(FollowMutation, ALeafIsNotOfTheCoreUnlessItIs) {
  for (const std::string& file : {closed_, open_}) {
    TakenApart parts(file);
    std::size_t core = 0;
    for (std::size_t leaf = 0; leaf < parts.leaves(); ++leaf) {
      if (stage_of(parts, leaf) == 0) continue;
      if (++core % 2 == 0) parts.put<std::uint16_t>("leaf_stage", leaf, 0);
    }
    expect_refused(parts, "leave the core");
    parts = TakenApart(file);
    const std::size_t joins = parts.find([&](std::size_t leaf) {
      return stage_of(parts, leaf) == 0 && parts.at<std::uint8_t>("leaf_verdict", leaf) == reach;
    });
    parts.put<std::uint16_t>("leaf_stage", joins, 1);
    expect_refused(parts, "could not be re-proved");
    parts = TakenApart(file);
    parts.put<std::uint16_t>("leaf_stage", core_leaf(parts), 0xffff);
    expect_refused(parts, "stage that does not exist");
    parts = TakenApart(file);
    parts.put<std::uint8_t>("leaf_verdict", core_leaf(parts), collide);
    expect_refused(parts, "is of the core, but is not claimed to follow");
    // Of which nothing is claimed, nothing would be proved again.
    parts.put<std::uint8_t>("leaf_verdict", core_leaf(parts), undecided);
    parts.put<std::uint32_t>("leaf_group", core_leaf(parts), 0);
    expect_refused(parts, "is of the core, but is not claimed to follow");
  }
}

TEST_F(FollowMutation, StagesArePassedInTheirOrder) {
  const TakenApart good(closed_);
  const auto stages = static_cast<int>(good.arrays.at("stage_off_rad").size() / 4);
  const std::size_t leaf = core_leaf(good);
  TakenApart parts = good;
  const int opposite = (stage_of(parts, leaf) - 1 + stages / 2) % stages + 1;
  parts.put<std::uint16_t>("leaf_stage", leaf, static_cast<std::uint16_t>(opposite));
  expect_refused(parts, "could not be re-proved");
  parts = good;  // to and fro between all
  for (std::size_t i = 0; i < parts.leaves(); ++i) {
    if (stage_of(parts, i) != 0) {
      parts.put<std::uint16_t>("leaf_stage", i, static_cast<std::uint16_t>(1 + i % 3));
    }
  }
  expect_refused(parts, "could not be re-proved");
  parts = good;  // one that is never left
  for (std::size_t i = 0; i < parts.leaves(); ++i) {
    if (stage_of(parts, i) != 0) parts.put<std::uint16_t>("leaf_stage", i, 1);
  }
  expect_refused(parts, "could not be re-proved");
}

TEST_F(FollowMutation, DirectionsOfStagesHoldAllHeadings) {
  const TakenApart good(closed_);
  const std::size_t k = stage_of(good, core_leaf(good)) - 1U;
  const float u = good.at<float>("stage_heading_rad", k);
  const float off = good.at<float>("stage_off_rad", k);
  ASSERT_GT(off, 0.0F);
  TakenApart parts = good;
  parts.put<float>("stage_heading_rad", k, u > 0.0F ? u - 3.1F : u + 3.1F);
  expect_refused(parts, "rad from its direction");
  parts.put<float>("stage_heading_rad", k, 4.0F);
  expect_refused(parts, "has an invalid direction");
  parts = good;  // of all: then a lap is said to be shorter than headings so far off allow
  parts.record["follow"]["lap_time_s"][1] =
      0.9 * parts.record["follow"]["lap_time_s"][1].get<double>();
  for (std::size_t i = 0; i < parts.arrays.at("stage_off_rad").size() / 4; ++i) {
    parts.put<float>("stage_off_rad", i, 0.5F * good.at<float>("stage_off_rad", i));
  }
  expect_refused(parts, "lap_time_s");
  parts = good;
  for (const float bad : {1.51F, -0.1F, HUGE_VALF}) {
    parts.put<float>("stage_off_rad", k, bad);
    expect_refused(parts, "has an invalid direction");
  }
  parts.put<float>("stage_off_rad", k, NAN);  // then its leaves are in groups: they are not
  expect_refused(parts, "could not be re-proved");
}

TEST_F(FollowMutation, TheTubeHoldsAllThatFollow) {
  for (const std::string& file : {closed_, open_}) {
    const TakenApart good(file);
    const std::size_t stretches = good.arrays.at("tube").size() / 8;
    for (const std::size_t number : {std::size_t{0}, std::size_t{1}}) {
      TakenApart parts = good;
      for (std::size_t k = 0; k < stretches; ++k) {
        parts.put<float>("tube", 2 * k + number, 0.8F * good.at<float>("tube", 2 * k + number));
      }
      expect_refused(parts, "leave the tube");
      parts.put<float>("tube", 2 * (stretches / 2) + number, NAN);
      expect_refused(parts, "leave the tube");
    }
    TakenApart parts = good;
    for (std::size_t i = 1; i < parts.arrays.at("path_m").size() / 8; i += 2) {
      parts.put<double>("path_m", i, good.at<double>("path_m", i) + 3.0);
    }
    expect_refused(parts, "leave the tube");
    parts.put<double>("path_m", 0, NAN);
    expect_refused(parts, "expected finite numbers");
  }
}

TEST_F(FollowMutation, APathTheOtherWayRoundIsNotFollowed) {
  TakenApart parts(closed_);
  const std::size_t n = parts.arrays.at("path_m").size() / 16;
  const TakenApart good = parts;
  for (std::size_t i = 0; i < n; ++i) {
    for (const std::size_t xy : {std::size_t{0}, std::size_t{1}}) {
      parts.put<double>("path_m", 2 * i + xy, good.at<double>("path_m", 2 * (n - 1 - i) + xy));
    }
  }
  expect_refused(parts, "could not be re-proved");
}

TEST_F(FollowMutation, LapsTakeNoLessAndNoLonger) {
  TakenApart parts(closed_);
  const double least = parts.record["follow"]["lap_time_s"][0];
  const double most = parts.record["follow"]["lap_time_s"][1];
  ASSERT_GT(least, 0.0);
  parts.record["follow"]["lap_time_s"] = {1.1 * least, most};
  expect_refused(parts, "lap_time_s");
  parts.record["follow"]["lap_time_s"] = {least, 0.9 * most};
  expect_refused(parts, "lap_time_s");
  parts.record["follow"]["lap_time_s"] = {least};
  expect_refused(parts, "lap_time_s");
  parts = TakenApart(open_);
  parts.record["follow"]["lap_time_s"] = {0.0, 0.98 * parts.at<float>("stage_time_s", 0)};
  expect_refused(parts, "lap_time_s");
  parts.put<float>("stage_time_s", 0, 1.0F);
  expect_refused(parts, "takes longer than its stage");
}

TEST_F(FollowMutation, StagesLieWhereThePathIs) {
  TakenApart parts(closed_);
  const std::size_t stages = parts.arrays.at("stage_station_m").size() / 4;
  std::vector<float> station(stages);
  for (std::size_t k = 0; k < stages; ++k) station[k] = parts.at<float>("stage_station_m", k);
  for (std::size_t k = 0; k < stages; ++k) {  // half a lap off
    parts.put<float>("stage_station_m", k, station[(k + stages / 2) % stages]);
  }
  expect_refused(parts, "far along the path");
}

TEST_F(FollowMutation, StagesGoRoundThePathOnce) {
  const TakenApart good(closed_);
  const std::size_t stages = good.arrays.at("stage_station_m").size() / 4;
  const std::size_t k = stages / 2;
  TakenApart parts = good;  // one back, and on again
  parts.put<float>("stage_station_m", k, good.at<float>("stage_station_m", k + 1));
  parts.put<float>("stage_station_m", k + 1, good.at<float>("stage_station_m", k));
  expect_refused(parts, "do not go round the path once");
}

TEST_F(FollowMutation, ALoopBesideThePathDoesNotGoRoundIt) {
  // A path that is far longer than the loop: all of it lies beside a short piece.
  TakenApart parts(closed_);
  const std::size_t vertices = parts.arrays.at("path_m").size() / 16;
  ASSERT_EQ(vertices % 4, 0U);
  const std::size_t by_side = vertices / 4;
  constexpr double side_m = 3000.0;
  for (std::size_t i = 0; i < vertices; ++i) {  // a square, its first side below the loop
    const double on_m = side_m * static_cast<double>(i % by_side) / static_cast<double>(by_side);
    const std::array<double, 4> x{on_m, side_m, side_m - on_m, 0.0};
    const std::array<double, 4> y{0.0, -on_m, -side_m, on_m - side_m};
    parts.put<double>("path_m", 2 * i, x[i / by_side] - 0.5 * side_m);
    parts.put<double>("path_m", 2 * i + 1, y[i / by_side]);
  }
  for (std::size_t i = 0; i < parts.arrays.at("tube").size() / 8; ++i) {
    parts.put<float>("tube", 2 * i, 1e4F);
    parts.put<float>("tube", 2 * i + 1, 7.0F);
  }
  // On the way back over the loop, one stage is passed over: it goes round for all.
  const std::size_t stages = parts.arrays.at("stage_station_m").size() / 4;
  const std::size_t passed = stages / 4;
  constexpr auto round_m = static_cast<float>(4.0 * side_m);
  constexpr float before_m = 0.125F * round_m + 128.0F - 0.2F * round_m;
  for (std::size_t k = 0; k < stages; ++k) {
    const float share =
        static_cast<float>((k + stages - passed - 1) % stages) / static_cast<float>(stages);
    parts.put<float>("stage_station_m", k, before_m + share * 0.4F * round_m);
  }
  parts.put<float>("stage_station_m", passed, before_m + 0.7F * round_m);
  for (std::size_t leaf = 0; leaf < parts.leaves(); ++leaf) {
    if (stage_of(parts, leaf) != passed + 1) continue;
    parts.put<std::uint16_t>("leaf_stage", leaf, static_cast<std::uint16_t>(passed));
  }
  parts.record["follow"]["lap_time_s"] = {0.0, 1e6};
  expect_refused(parts, "jump along the path");
}

TEST_F(FollowMutation, EndsAreAtTheEndOfThePath) {
  // A path that goes on beyond the cells where flights end.
  TakenApart parts(open_);
  const std::size_t last_x = parts.arrays.at("path_m").size() / 8 - 2;
  parts.put<double>("path_m", last_x, parts.at<double>("path_m", last_x) + 60.0);
  expect_refused(parts, "is not at the end of the path");
}

TEST(LapSums, WhoHeadsFartherOffThanClaimedTakesLonger) {
  // A square of 100 m, by stages along its sides.
  FollowClaims f;
  for (int k = 0; k < 4; ++k) {
    f.heading_rad.push_back(static_cast<float>(0.5 * std::numbers::pi * k));
    f.off_rad.push_back(0.1F);
    f.time_s.push_back(0.0F);
    f.station_m.push_back(100.0F * static_cast<float>(k));
  }
  ContractCertificate c;
  c.contract.least_speed = c.contract.most_speed = 10.0;
  const auto defect_with = [&](double lap_most_s, bool slow, std::size_t jump) {
    c.follow = f;
    c.follow->lap_most_s = lap_most_s;
    LapSums sums(c);
    sums.pass(0, jump, {100.0, 0.0});
    if (jump == 1) sums.pass(1, 1, {100.0, 100.0});
    sums.pass(1, 1, {100.0, 100.0});
    sums.pass(2, 1, {0.0, 100.0});
    sums.pass(3, 1, {0.0, 0.0});
    if (slow) sums.slow_down(1, 1.2);
    return sums.defect(c);
  };
  const double side_s = 10.0;
  const double lap_s = 4.0 * side_s / std::cos(0.1);
  EXPECT_EQ(defect_with(1.001 * lap_s, false, 1), "");
  EXPECT_NE(defect_with(0.999 * lap_s, false, 1), "");
  // One side at 1.2 rad off.
  const double slow_s = lap_s + side_s * (1.0 / std::cos(1.2) - 1.0 / std::cos(0.1));
  EXPECT_NE(defect_with(0.999 * slow_s, true, 1), "");
  EXPECT_EQ(defect_with(1.001 * slow_s, true, 1), "");
  // Some pass from stage 0 to 2 where others come to stage 1: they begin it there.
  EXPECT_NE(defect_with(0.999 * slow_s, true, 2), "");
}

TEST_F(FollowMutation, WhoHoldsStaysInItsDisc) {
  const TakenApart good(hold_);
  EXPECT_EQ(refusal(good), "");
  EXPECT_GT(good.record["volume_fraction"]["reach"], 0.3);
  TakenApart parts = good;
  json& hold = parts.record["follow"]["hold"];
  const double radius_m = hold["radius_m"];
  hold["radius_m"] = 0.99 * radius_m;
  expect_refused(parts, "the tube is not in the disc");
  hold["radius_m"] = 2.0 * radius_m;  // less is claimed
  EXPECT_EQ(refusal(parts), "");
  hold["goal_m"] = {128.0, 108.0};
  hold["radius_m"] = radius_m;
  expect_refused(parts, "the tube is not in the disc");
  hold["goal_m"] = {128.0};
  expect_refused(parts, "goal_m");
  parts = good;  // then laps would be proved
  parts.record["follow"].erase("hold");
  expect_refused(parts, "stages");
  parts = good;
  parts.record["follow"]["lap_time_s"] = {1.0, 2.0};
  expect_refused(parts, "lap_time_s");
  parts = good;
  std::size_t core = 0;
  for (std::size_t leaf = 0; leaf < parts.leaves(); ++leaf) {
    if (stage_of(parts, leaf) != 0 && ++core % 2 == 0)
      parts.put<std::uint16_t>("leaf_stage", leaf, 0);
  }
  expect_refused(parts, "leave the core");
}

TEST_F(FollowMutation, ThePathIsThatOfThePlansMission) {
  const fairway::PathMission ellipse = fairway::ellipse_to_follow();
  const fairway::Plan plan = plan_along(ellipse, 32, 30);
  EXPECT_EQ(refusal_for(closed_, plan, ellipse), "");
  const auto changed = [&](const auto& change) {
    fairway::PathMission path = ellipse;
    change(path);
    return refusal_for(closed_, plan, path);
  };
  EXPECT_THAT(changed([](auto& path) { path.closed = false; }),
              testing::HasSubstr("another kind of path"));
  EXPECT_THAT(
      changed([](auto& path) { std::reverse(path.vertices_m.begin(), path.vertices_m.end()); }),
      testing::HasSubstr("another way"));
  const double radius_m = plan.vehicle.turn_radius_m;
  const auto with_spike = [&](double far_m) {  // beside the path: at its middle piece, outwards
    return changed([&](auto& path) {
      const std::size_t k = path.vertices_m.size() / 2;
      const fairway::Vec2 a = path.vertices_m[k - 1];
      const fairway::Vec2 by = path.vertices_m[k] - a;
      const fairway::Vec2 out = (far_m / norm(by)) * fairway::Vec2{by.y, -by.x};
      path.vertices_m.insert(path.vertices_m.begin() + static_cast<std::ptrdiff_t>(k),
                             a + 0.5 * by + out);
    });
  };
  EXPECT_THAT(with_spike(2.0 * radius_m), testing::HasSubstr("path_m is not its path"));
  EXPECT_EQ(with_spike(0.5 * radius_m), "");  // as a corner that is cut
  EXPECT_THAT(changed([](auto& path) { path.vertices_m.resize(path.vertices_m.size() / 2); }),
              testing::HasSubstr("path_m is not its path"));
  EXPECT_THAT(refusal_for(closed_, plan, fairway::GoalMission{fairway::Vec2{128.0, 128.0}, {}}),
              testing::HasSubstr("another kind of path"));
}

TEST_F(FollowMutation, AnOpenPathBeginsAndEndsWhereTheMissionsDoes) {
  const fairway::PathMission line = fairway::line_to_follow();
  const fairway::Plan plan = plan_along(line, 30, 15);
  EXPECT_EQ(refusal_for(open_, plan, line), "");
  fairway::PathMission longer = line;
  const fairway::Vec2 end = longer.vertices_m.back();
  longer.vertices_m.push_back(end + fairway::Vec2{0.0, 0.5 * plan.vehicle.turn_radius_m});
  EXPECT_THAT(refusal_for(open_, plan, longer), testing::HasSubstr("another way"));
  longer.vertices_m = line.vertices_m;
  std::reverse(longer.vertices_m.begin(), longer.vertices_m.end());
  EXPECT_THAT(refusal_for(open_, plan, longer), testing::HasSubstr("another way"));
}

TEST_F(FollowMutation, TheDiscIsAboutThePlansGoal) {
  const fairway::Plan plan = plan_that_holds();
  auto goal = std::get<fairway::GoalMission>(*plan.record.mission);
  EXPECT_EQ(refusal_for(hold_, plan, goal), "");
  const double radius_m = TakenApart(hold_).record["follow"]["hold"]["radius_m"];
  goal.hold_radius_m = 1.01 * radius_m;
  EXPECT_EQ(refusal_for(hold_, plan, goal), "");
  goal.hold_radius_m = 0.99 * radius_m;
  EXPECT_THAT(refusal_for(hold_, plan, goal), testing::HasSubstr("wider than asked for"));
  goal.hold_radius_m.reset();
  goal.goal_m.x += 1.0;
  EXPECT_THAT(refusal_for(hold_, plan, goal), testing::HasSubstr("holds at another place"));
  goal.goal_m.x -= 1.0;
  goal.hold = false;
  EXPECT_THAT(refusal_for(hold_, plan, goal), testing::HasSubstr("holds at another place"));
}

TEST_F(FollowMutation, OpenIsNotClosed) {
  TakenApart parts(closed_);
  parts.record["follow"]["closed"] = false;
  expect_refused(parts, "stages");
  parts = TakenApart(open_);
  parts.record["follow"]["closed"] = true;
  expect_refused(parts, "stages");
  parts = TakenApart(open_);
  parts.record.erase("follow");
  expect_refused(parts, "arrays");
}

TEST_F(FollowMutation, TimesToJoinAndToTheEndBound) {
  for (const std::string& file : {closed_, open_}) {
    const TakenApart good(file);
    std::size_t last = 0;
    for (std::size_t g = 1; g < good.arrays.at("group_time_s").size() / 4; ++g) {
      if (good.at<float>("group_time_s", g) > good.at<float>("group_time_s", last) || last == 0) {
        last = g;
      }
    }
    TakenApart parts = good;
    parts.put<float>("group_time_s", last, 0.5F * good.at<float>("group_time_s", last));
    expect_refused(parts, "");
    EXPECT_NE(refusal(parts), "");
  }
}

}  // namespace
}  // namespace fairway_check
