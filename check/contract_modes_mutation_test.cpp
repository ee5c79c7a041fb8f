// Contract certificates of plans with further modes: accepted as the prover makes them, refused
// once changed.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "check/contract_proof.hpp"
#include "check/proof.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/inclusion/contract_modes.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/vehicle/modes.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway_check {
namespace {

namespace fs = std::filesystem;

/// A goal among walls, with a field that leads to it; mode 1 goes on in one direction.
fairway::ContractCertificate proved() {
  fairway::Plan plan = fairway::empty_plan(16, 12, 1.0, 1.6);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const fairway::Cell c = plan.grid.cell_at(i);
    const double x = c.ix - 9.0;
    const double y = c.iy - 6.0;
    plan.heading_rad[i] = static_cast<float>(0.999 * std::atan2(-y, -x));
    float on = 0.4F;
    if (x * x + y * y < 5.0) plan.region[i] = fairway::Region::goal;
    if (c.ix == 3 && c.iy > 4) {
      plan.region[i] = fairway::Region::obstacle;
      plan.heading_rad[i] = on = std::numeric_limits<float>::quiet_NaN();
    }
    plan.mode_heading_rad.push_back(on);
  }
  fairway::ContractCertificate c;
  c.grid = plan.grid;
  c.vehicle = plan.vehicle;
  c.contract = fairway::VehicleContract::of(plan.vehicle);
  c.contract.command_error_m = 0.05;
  c.contract.heading_error_rad = 0.01;
  c.heading_rad = plan.heading_rad;
  c.region = plan.region;
  c.kind = fairway::cell_kinds(plan.grid, plan.region, {});
  c.plan = fairway::plan_digests(plan);
  const fairway::Parts parts = c.parts();
  fairway::InclusionLimits limits;
  limits.last_level = 3;
  fairway::InclusionProver prover(parts, limits);
  prover.run([](const fairway::InclusionLevel&) {});
  c.verdicts = prover.verdicts(c.least_speed_mps());
  const fairway::ContractModesProof modes = fairway::prove_contract_modes(
      c.flow(), plan.further_rad(), c.contract, 1, fairway::EstimateError::of(c.contract),
      {parts, c.verdicts}, limits, [](int) {});
  c.mode_heading_rad = plan.mode_heading_rad;
  c.mode_verdicts = joined(modes.further);
  return c;
}

std::string told_of(const fairway::ContractCertificate& c) {
  const fs::path path =
      fs::temp_directory_path() / ("fairway-contract-modes-" + std::to_string(::getpid()));
  write_contract_certificate(c, path, fairway::Existing::replace);
  nlohmann::ordered_json report;
  std::string wrong = judge(path.string(), "", 1000, report);
  fs::remove(path);
  return wrong;
}

/// The first leaf of a further mode that is handed over, or not.
std::size_t first_leaf(const fairway::ContractVerdicts& m, bool handed_over) {
  for (std::size_t leaf = 0; leaf < m.leaves(); ++leaf) {
    const bool reaches = m.group[leaf] != 0;
    if (handed_over ? m.group_next_mode[m.group[leaf]] != fairway::no_mode : !reaches) return leaf;
  }
  ADD_FAILURE() << "there is no such leaf";
  return 0;
}

TEST(ContractModesMutation, WhateverTheProverProvesIsAcceptedAndReadAgain) {
  const fairway::ContractCertificate c = proved();
  EXPECT_EQ(told_of(c), "");
  const fs::path path =
      fs::temp_directory_path() / ("fairway-contract-modes-read-" + std::to_string(::getpid()));
  write_contract_certificate(c, path, fairway::Existing::replace);
  const fairway::ContractCertificate again = fairway::read_contract_certificate(path);
  fs::remove(path);
  EXPECT_EQ(again.mode_heading_rad.size(), c.mode_heading_rad.size());  // some are NaN
  EXPECT_EQ(again.mode_verdicts.begin, c.mode_verdicts.begin);
  EXPECT_EQ(again.mode_verdicts.first, c.mode_verdicts.first);
  EXPECT_EQ(again.mode_verdicts.group, c.mode_verdicts.group);
  EXPECT_EQ(again.mode_verdicts.group_next_mode, c.mode_verdicts.group_next_mode);
}

TEST(ContractModesMutation, ALeafThatIsNotHandedOverIsRefused) {
  fairway::ContractCertificate c = proved();
  fairway::ContractVerdicts& m = c.mode_verdicts;
  const std::size_t from = first_leaf(m, true);
  const std::size_t to = first_leaf(m, false);
  m.verdict[to] = m.verdict[from];
  m.group[to] = m.group[from];
  EXPECT_NE(told_of(c).find("is handed over to mode 0"), std::string::npos) << told_of(c);
}

TEST(ContractModesMutation, ATimeThatIsTooShortIsRefused) {
  fairway::ContractCertificate c = proved();
  fairway::ContractVerdicts& m = c.mode_verdicts;
  m.group_time_s[m.group[first_leaf(m, true)]] *= 0.3F;
  EXPECT_NE(told_of(c).find("takes up to"), std::string::npos) << told_of(c);
}

TEST(ContractModesMutation, AModeHandsOverToEarlierOnesOnly) {
  fairway::ContractCertificate c = proved();
  fairway::ContractVerdicts& m = c.mode_verdicts;
  m.group_next_mode[m.group[first_leaf(m, true)]] = 1;
  EXPECT_NE(told_of(c).find("invalid verdict or group"), std::string::npos) << told_of(c);
}

TEST(ContractModesMutation, AWorseEstimateIsRefused) {
  fairway::ContractCertificate c = proved();
  c.contract.command_error_m *= 4.0;
  EXPECT_NE(told_of(c), "");
}

TEST(ContractModesMutation, OtherCommandsOfAFurtherModeAreRefused) {
  fairway::ContractCertificate c = proved();
  for (float& command : c.mode_heading_rad) command = -command;
  EXPECT_NE(told_of(c).find("mode_heading_rad"), std::string::npos) << told_of(c);
}

}  // namespace
}  // namespace fairway_check
