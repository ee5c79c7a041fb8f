// Certificates under a contract, made by the prover: accepted as they are, refused once changed.
//
// Faults planted by hand in the checker, each with the first test that caught it (F: one of
// ContractFlight.TellsOfAllThatFlightsFrom...; the others by name):
//   arc one degree short                           F
//   a step of the clock skipped                    F
//   a deep overlap taken for contact               F
//   contact ignored whatever the heading           F
//   hold rule dropped                              F
//   hold rule dropped in wide arcs                 Choices.AHeldSideMayLeadOutOfAWideArc
//   radius spread dropped                          F
//   command error (rho) ignored                    F
//   heading error ignored                          F
//   a bound called exact kept for ever             F
//   far turn-back dropped                          F
//   obstacle shrunk                                F
//   wild part ignored                              F
//   roaming turn halved                            F
//   side_uncertain ignored                         F
//   nearest-command fill ignored                   F
//   last of equally near commands                  F
//   joining behaviours forgotten                   F
//   cone of one heading                            F
//   turn-back call dropped                         ContractFlight.TellsOfThoseThatTurnBack...
//   chord of a step instead of its arc             Displacements.HoldEveryArcOfTheLeastRadius...
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>

#include "check/testing/refusal.hpp"
#include "check/testing/taken_apart.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway_check {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A goal in the middle of a field that leads to it, with a wall and an edge to meet.
fairway::Plan a_plan(double skew) {
  fairway::Plan plan = fairway::empty_plan(16, 12, 8.0, 20.0);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const fairway::Cell c = plan.grid.cell_at(i);
    const double x = c.ix - 9.0;
    const double y = c.iy - 6.0;
    plan.heading_rad[i] = static_cast<float>(
        0.9999 * std::remainder(std::atan2(-y, -x) + skew, 2.0 * std::numbers::pi));
    if (x * x + y * y < 5.0) plan.region[i] = fairway::Region::goal;
    if (c.ix == 3 && c.iy > 4) plan.region[i] = fairway::Region::obstacle;
    if (c.ix < 2) plan.heading_rad[i] = static_cast<float>(c.iy < 6 ? -2.0 : 1.0);
  }
  return plan;
}

fairway::VehicleContract a_contract() {
  fairway::VehicleContract contract;
  contract.command_error_m = 2.0;
  contract.heading_error_rad = 0.02;
  contract.turn_radius_m = {18.0, 22.0};
  contract.speed_mps = {9.0, 11.0};
  return contract;
}

class ContractMutation : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("fairway-contract-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    const fairway::Plan plan = a_plan(0.1);
    write_plan(plan, folder_ / "plan", fairway::Existing::replace);
    write_plan(a_plan(0.2), folder_ / "other", fairway::Existing::replace);
    fairway::ContractVerifyOptions options;
    options.parts_per_cell = 2;
    options.samples = 20000;
    options.find_witnesses = false;
    const auto made = fairway::verify_contract(plan, "plan", fairway::RegionOfInterest{},
                                               a_contract(), options, [](const std::string&) {});
    write_contract_certificate(made.certificate, folder_ / "good", fairway::Existing::replace);
    std::ifstream in(folder_ / "good", std::ios::binary);
    good_ = {std::istreambuf_iterator<char>(in), {}};
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static std::string refusal(const std::string& bytes, const std::string& plan = "") {
    std::ofstream(folder_ / "changed", std::ios::binary) << bytes;
    return refusal_of(folder_ / "changed", plan, 5000);
  }
  static void expect_refused(TakenApart parts, const std::string& because) {
    parts.sign();
    EXPECT_THAT(refusal(parts.file()), testing::HasSubstr(because));
  }
  static std::uint32_t group_of(const TakenApart& parts, std::size_t leaf) {
    return parts.at<std::uint32_t>("leaf_group", leaf);
  }

  static fs::path folder_;
  static std::string good_;
};
fs::path ContractMutation::folder_;
std::string ContractMutation::good_;

TEST_F(ContractMutation, OfAPlanWithModesIsOneOfItsOwnField) {
  fairway::Plan plan = a_plan(0.1);
  plan.mode_heading_rad.assign(2 * plan.grid.size(), 0.5F);
  plan.record.modes = {{"direction", 0.5}, {"direction", 0.5}};
  write_plan(plan, folder_ / "with_modes", fairway::Existing::replace);
  fairway::ContractVerifyOptions options;
  options.parts_per_cell = 1;
  options.samples = 2000;
  options.find_witnesses = false;
  const auto made = fairway::verify_contract(plan, "plan", fairway::RegionOfInterest{},
                                             a_contract(), options, [](const std::string&) {});
  write_contract_certificate(made.certificate, folder_ / "of_modes", fairway::Existing::replace);
  EXPECT_EQ(refusal_of(folder_ / "of_modes", folder_ / "with_modes", 2000), "");
  EXPECT_THAT(refusal_of(folder_ / "of_modes", folder_ / "plan", 0),
              testing::HasSubstr("is not the certificate of the plan"));
  EXPECT_THAT(refusal_of(folder_ / "good", folder_ / "with_modes", 0),
              testing::HasSubstr("is not the certificate of the plan"));
  plan.mode_heading_rad[7] = 0.75F;
  write_plan(plan, folder_ / "with_others", fairway::Existing::replace);
  EXPECT_THAT(refusal_of(folder_ / "of_modes", folder_ / "with_others", 0),
              testing::HasSubstr("is not the certificate of the plan"));
}

TEST_F(ContractMutation, WhateverTheProverProvesIsAccepted) {
  // Obstacles that meet at corners, narrow arcs side by side, one radius, almost no error.
  for (int round = 0; round < 3; ++round) {
    std::mt19937_64 random(static_cast<unsigned>(round));
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    fairway::Plan plan = a_plan(0.05 * round);
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      if (plan.region[i] == fairway::Region::goal) continue;
      if (below(8) == 0) plan.region[i] = fairway::Region::obstacle;
      const fairway::Cell c = plan.grid.cell_at(i);
      if (round % 2 == 0 && c.ix > 9) {
        plan.heading_rad[i] = static_cast<float>(c.ix % 2 == 0 ? 1.5708 : 1.5);
      }
    }
    fairway::VehicleContract contract = a_contract();
    if (round % 4 < 2) contract.command_error_m = 0.0;
    if (round % 4 != 1) contract.heading_error_rad = 0.0001;
    if (round % 3 == 0) contract.turn_radius_m = {20.0, 20.0};
    fairway::ContractVerifyOptions options;
    options.parts_per_cell = 1 + round % 3;
    options.samples = 1;
    options.find_witnesses = false;
    const auto made = fairway::verify_contract(plan, "plan", fairway::RegionOfInterest{}, contract,
                                               options, [](const std::string&) {});
    write_contract_certificate(made.certificate, folder_ / "made", fairway::Existing::replace);
    nlohmann::ordered_json report;
    EXPECT_EQ(judge(folder_ / "made", "", 0, report), "") << "round " << round;
  }
}

TEST_F(ContractMutation, AnArcThatOnlyTheProversReachesOverASideIsAccepted) {
  // All fly west, nearly along the sides of their parts: by the prover's arc just over them.
  fairway::Plan plan = fairway::empty_plan(8, 6, 8.0, 20.0);
  const float west = 3.1F;
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    plan.heading_rad[i] = west;
    if (plan.grid.cell_at(i).ix == 0) plan.region[i] = fairway::Region::goal;
  }
  fairway::VehicleContract contract = a_contract();
  contract.heading_error_rad = std::numbers::pi - 0.99 * 0x1p-22 - static_cast<double>(west);
  fairway::ContractVerifyOptions options;
  options.samples = 1000;
  options.find_witnesses = false;
  const auto made = fairway::verify_contract(plan, "plan", fairway::RegionOfInterest{}, contract,
                                             options, [](const std::string&) {});
  write_contract_certificate(made.certificate, folder_ / "made", fairway::Existing::replace);
  nlohmann::ordered_json report;
  EXPECT_EQ(judge(folder_ / "made", "", 0, report), "");
  EXPECT_GT(report["leaves"]["reach"], 20);
}

TEST_F(ContractMutation, TheCertificateIsAcceptedWithItsPlanAndNoOther) {
  EXPECT_EQ(refusal(good_), "");
  EXPECT_EQ(refusal(good_, folder_ / "plan"), "");
  EXPECT_THAT(refusal(good_, folder_ / "other"), testing::HasSubstr("not the certificate of"));
  TakenApart parts(good_);
  parts.sign();
  EXPECT_EQ(refusal(parts.file()), "");
  // Verdicts of several kinds, groups with and without links inside.
  parts.leaf_with(reach);
  parts.leaf_with(collide);
  parts.leaf_with(leave);
  int directed = 0;
  for (std::size_t g = 0; g < parts.arrays.at("group_time_s").size() / 4; ++g) {
    directed += std::isnan(parts.at<float>("group_heading_rad", g)) ? 0 : 1;
  }
  EXPECT_GT(directed, 0);
}

TEST_F(ContractMutation, AnotherVerdictIsRefused) {
  const TakenApart good(good_);
  for (const Verdict from : {reach, collide, leave}) {
    for (const Verdict to : {reach, collide, leave, trapped, undecided}) {
      if (from == to) continue;
      TakenApart parts = good;
      const std::size_t leaf = parts.leaf_with(from);
      parts.put<std::uint8_t>("leaf_verdict", leaf, to);
      if (to == trapped || to == undecided) parts.put<std::uint32_t>("leaf_group", leaf, 0);
      parts.sign();
      // That nothing is claimed of one leaf may be true; but others come to it.
      const std::string why = refusal(parts.file());
      EXPECT_TRUE(to == undecided || !why.empty()) << from << " " << to;
    }
  }
  TakenApart parts = good;
  const std::size_t leaf = parts.leaf_with(undecided);
  parts.put<std::uint8_t>("leaf_verdict", leaf, reach);
  parts.put<std::uint32_t>("leaf_group", leaf, 1);
  expect_refused(parts, "could not be re-proved");
}

TEST_F(ContractMutation, ALeafWithoutAVerdictUnderminesThoseThatComeToIt) {
  TakenApart parts(good_);
  const std::size_t leaves = parts.leaves();
  for (std::size_t leaf = 0; leaf < leaves; leaf += 2) {
    parts.put<std::uint8_t>("leaf_verdict", leaf, undecided);
    parts.put<std::uint32_t>("leaf_group", leaf, 0);
  }
  expect_refused(parts, "re-proved outcomes: undecided");
}

TEST_F(ContractMutation, GroupsMustNotRise) {
  TakenApart parts(good_);
  // The last group of leaves that reach comes to others: below them it is refused.
  std::size_t last = parts.leaf_with(reach);
  for (std::size_t leaf = 0; leaf < parts.leaves(); ++leaf) {
    if (parts.at<std::uint8_t>("leaf_verdict", leaf) == reach &&
        group_of(parts, leaf) > group_of(parts, last)) {
      last = leaf;
    }
  }
  parts.put<std::uint32_t>("leaf_group", last, 1);
  expect_refused(parts, "group");
  parts.put<std::uint32_t>("leaf_group", last, 1U << 30);
  expect_refused(parts, "has an invalid verdict or group");
  parts.put<std::uint32_t>("leaf_group", last, 0);
  expect_refused(parts, "has an invalid verdict or group");
}

TEST_F(ContractMutation, ProgressMustBeMadeInTheGroupsDirection) {
  const TakenApart good(good_);
  for (std::size_t g = 1; g < good.arrays.at("group_time_s").size() / 4; ++g) {
    const float u = good.at<float>("group_heading_rad", g);
    if (std::isnan(u)) continue;
    TakenApart parts = good;
    parts.put<float>("group_heading_rad", g, NAN);
    expect_refused(parts, "has no direction");
    parts.put<float>("group_heading_rad", g, u > 0.0F ? u - 3.1F : u + 3.1F);
    expect_refused(parts, "from the direction of progress");
    parts.put<float>("group_heading_rad", g, u > 0.0F ? u - 1.55F : u + 1.55F);
    expect_refused(parts, "");
    parts.put<float>("group_heading_rad", g, 7.0F);
    expect_refused(parts, "has an invalid direction or time");
    return;
  }
  FAIL() << "no group with links inside";
}

TEST_F(ContractMutation, TimesMustBound) {
  const TakenApart good(good_);
  const std::size_t groups = good.arrays.at("group_time_s").size() / 4;
  for (const std::size_t g : {std::size_t{1}, groups / 2, groups - 1}) {
    TakenApart parts = good;
    const float t = good.at<float>("group_time_s", g);
    if (t < 1.0F) continue;
    parts.put<float>("group_time_s", g, 0.7F * t);
    expect_refused(parts, "takes up to");
    parts.put<float>("group_time_s", g, NAN);
    expect_refused(parts, "has an invalid direction or time");
    parts.put<float>("group_time_s", g, -1.0F);
    expect_refused(parts, "has an invalid direction or time");
  }
  TakenApart parts = good;
  parts.put<float>("group_time_s", 0, 5.0F);
  expect_refused(parts, "group 0");
}

TEST_F(ContractMutation, ShiftedLeavesAreRefused) {
  const TakenApart good(good_);
  const std::size_t inner = good.find([&](std::size_t leaf) {
    return good.at<std::uint32_t>("leaf_begin", leaf) != 0 &&
           good.at<std::uint8_t>("leaf_verdict", leaf) == reach &&
           good.at<std::uint8_t>("leaf_verdict", leaf - 1) != reach;
  });
  TakenApart parts = good;
  parts.put<std::uint32_t>("leaf_begin", inner, 1);  // now reaches where others end
  expect_refused(parts, "could not be re-proved");
  parts.put<std::uint32_t>("leaf_begin", inner, 0);
  expect_refused(parts, "leaves do not ascend");
  parts = good;
  parts.put<std::uint32_t>("leaf_begin", 0, 5);
  expect_refused(parts, "leaves do not ascend");
}

TEST_F(ContractMutation, SectionsMustHaveLeavesWhereTheirPartIsOrdinary) {
  const TakenApart good(good_);
  TakenApart parts = good;
  const std::size_t sections = parts.arrays.at("section_first").size() / 4 - 1;
  const auto first = [&](std::size_t s) { return good.at<std::uint32_t>("section_first", s); };
  std::size_t s = 0;
  while (first(s) == first(s + 1)) ++s;
  parts.put<std::uint32_t>("section_first", s + 1, first(s));
  expect_refused(parts, "a section has leaves where it cannot");
  parts = good;
  parts.put<std::uint32_t>("section_first", s + 1, first(sections));
  expect_refused(parts, "section_first");
}

TEST_F(ContractMutation, AnotherContractIsRefused) {
  const auto with = [](const char* key, const json& value) {
    TakenApart parts(good_);
    parts.record["contract"][key] = value;
    return parts;
  };
  expect_refused(with("command_error_m", 6.0), "leaves");
  expect_refused(with("look_ahead_m", 6.0), "leaves");
  expect_refused(with("heading_error_rad", 0.3), "leaves");
  expect_refused(with("turn_radius_m", {12.0, 30.0}), "leaves");
  expect_refused(with("speed_mps", {5.0, 11.0}), "takes up to");
  expect_refused(with("wind_mps", 3.0), "leaves");
  expect_refused(with("side_uncertain_rad", 1.5), "leaves");
  expect_refused(with("command_error_m", -1.0), "command_error_m: out of range");
  expect_refused(with("heading_error_rad", "0.02"), "unreadable");
  expect_refused(with("hold_side_rad", 4.0), "hold_side_rad: out of range");
  expect_refused(with("wind_mps", 9.0), "wind_mps: out of range");
  expect_refused(with("turn_radius_m", {22.0, 18.0}), "turn_radius_m");
  expect_refused(with("turn_radius_m", {21.0, 22.0}), "does not hold the plan's turning radius");
  TakenApart parts(good_);
  parts.record["contract"].erase("wind_mps");
  expect_refused(parts, "unreadable");
  // Under a tighter one it is as true.
  TakenApart tighter = with("turn_radius_m", {19.0, 21.0});
  tighter.sign();
  EXPECT_EQ(refusal(tighter.file()), "");
}

TEST_F(ContractMutation, OtherPartsFormatsAndCellsAreRefused) {
  for (const json& k : {json(1), json(4), json(0), json(17), json(2.0), json("2")}) {
    TakenApart parts(good_);
    parts.record["parts_per_cell"] = k;
    expect_refused(parts, "");
    parts.sign();
    EXPECT_NE(refusal(parts.file()), "") << k.dump();
  }
  TakenApart parts(good_);
  parts.record["format_version"] = 2;
  expect_refused(parts, "unreadable");
  parts = TakenApart(good_);
  parts.record["method"] = "certified";
  expect_refused(parts, "unreadable");
  parts = TakenApart(good_);
  parts.record["region_of_interest"] = {0.0, 0.0, 8.0, 8.0};
  expect_refused(parts, "has an invalid command, region or cell_kind");
  parts = TakenApart(good_);
  parts.put<float>("heading_rad", 40, 1.0F);
  EXPECT_THAT(refusal(parts.file()), testing::HasSubstr("digest mismatch"));
  parts = TakenApart(good_);
  parts.put<double>("geometry", 3, 40.0);
  expect_refused(parts, "does not hold the plan's turning radius");
}

TEST_F(ContractMutation, ClaimedSharesMustBeThoseOfSampledStates) {
  TakenApart parts(good_);
  json& shares = parts.record["volume_fraction"];
  const double reached = shares["reach"];
  const double open = shares["undecided"];
  shares["reach"] = reached + open;
  shares["undecided"] = 0.0;
  if (open > 0.05) expect_refused(parts, "is claimed as");
  const double collided = shares["collide"];
  shares["undecided"] = open;
  shares["reach"] = reached - 0.2;
  shares["collide"] = collided + 0.2;
  expect_refused(parts, "is claimed as");
  // Less may be claimed than is true.
  shares["collide"] = collided;
  shares["undecided"] = open + 0.2;
  parts.sign();
  EXPECT_EQ(refusal(parts.file()), "");
}

}  // namespace
}  // namespace fairway_check
