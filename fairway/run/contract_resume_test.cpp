// An earlier proof under a contract is continued only when it is of the same question, and what it
// lost is told.
#include "fairway/run/contract_resume.hpp"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/verify/testing/plans_along_paths.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

ContractVerification verified(std::uint64_t seed, const EarlierContractProof* earlier = nullptr) {
  const Plan plan = random_plan(seed);
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  contract.command_error_m = 0.2 * plan.grid.cell_m;
  ContractVerifyOptions options;
  options.samples = 1000;
  options.find_witnesses = false;
  options.parts_per_cell = 1;
  return verify_contract(
      plan, "the plan", {}, contract, options, [](const std::string&) {}, earlier);
}

TEST(ContractResume, NamesWhatDiffers) {
  const ContractCertificate same = verified(3).certificate;
  EXPECT_EQ(difference(same, same), "");
  const auto words_of = [&](const auto& change) {
    ContractCertificate other = same;
    change(other);
    EXPECT_THROW(require_same_proof({other, "earlier"}, same), InputError);
    return difference(other, same);
  };
  EXPECT_NE(words_of([](auto& c) {
              c.contract.heading_error_rad = 0.5;
            }).find("heading_error_rad is 0.5 there and 0.0 now"),
            std::string::npos);
  EXPECT_NE(words_of([](auto& c) { c.parts_per_cell = 7; }).find("--parts 7"), std::string::npos);
  EXPECT_NE(words_of([](auto& c) { c.plan.heading_rad = "00"; }).find("commands"),
            std::string::npos);
  EXPECT_NE(words_of([](auto& c) { c.plan.cost_m = "00"; }).find("costs"), std::string::npos);
  EXPECT_NE(words_of([](auto& c) { c.plan.region = "00"; }).find("regions"), std::string::npos);
  EXPECT_NE(words_of([](auto& c) { ++c.grid.nx; }).find("cells"), std::string::npos);
  EXPECT_NE(words_of([](auto& c) { c.grid.x0_m += 1.0; }).find("elsewhere"), std::string::npos);
  EXPECT_NE(words_of([](auto& c) { c.vehicle.speed_mps += 1.0; }).find("vehicle"),
            std::string::npos);
  EXPECT_NE(words_of([](auto& c) { c.frame.emplace().world_from_grid.x_m = 1.0; }).find("frame"),
            std::string::npos);
  EXPECT_NE(words_of([](auto& c) { c.kind[0] = CellKind::target; }).find("--region"),
            std::string::npos);
}

TEST(ContractResume, CountsLeavesThatNoLongerHold) {
  const ContractVerification made = verified(3);
  const EarlierContractProof earlier{made.certificate, "earlier"};
  ContractVerdicts now = made.certificate.verdicts;
  const Resumed all = taken_over(earlier, now, false);
  EXPECT_GT(all.decided, 10U);
  EXPECT_EQ(all.dropped, 0U);
  EXPECT_TRUE(all.in_time);
  std::size_t withdrawn = 0;
  for (std::size_t k = 0; k < now.leaves(); k += 3) {
    withdrawn += now.verdict[k] != 0 ? 1 : 0;
    now.verdict[k] = 0;
  }
  EXPECT_EQ(taken_over(earlier, now, false).dropped, withdrawn);
  EXPECT_FALSE(taken_over(earlier, now, false).in_time);
  EXPECT_TRUE(taken_over(earlier, now, true).in_time);
}

TEST(ContractResume, ProvesAllAgainAndSaysSo) {
  for (std::uint64_t seed = 3; seed < 6; ++seed) {
    const EarlierContractProof earlier{verified(seed).certificate, "earlier"};
    const ContractVerification made = verified(seed, &earlier);
    ASSERT_TRUE(made.resumed);
    EXPECT_EQ(made.resumed->dropped, 0U);
    EXPECT_EQ(made.resumed->from, "earlier");
  }
}

ContractVerification followed(const Plan& plan, const EarlierContractProof* earlier) {
  ContractVerifyOptions options;
  options.samples = 1000;
  options.find_witnesses = false;
  return verify_contract(
      plan, "the plan", {}, contract_to_follow(), options, [](const std::string&) {}, earlier);
}

/// What goes on from a certificate that claims too much is what goes on from an honest one.
void expect_nothing_believed(const Plan& plan, const ContractCertificate& earlier,
                             const ContractCertificate& expected) {
  EarlierContractProof lies{earlier, "lies"};
  ContractVerdicts& v = lies.certificate.verdicts;
  std::fill(v.verdict.begin(), v.verdict.end(), static_cast<std::uint8_t>(Verdict::reach));
  std::fill(v.group.begin(), v.group.end(), 1U);
  std::fill(v.group_time_s.begin() + 1, v.group_time_s.end(), 0.0F);
  FollowProof& follow = *lies.certificate.follow;
  std::fill(follow.leaf_stage.begin(), follow.leaf_stage.end(), std::uint16_t{1});
  std::fill(follow.tube.begin(), follow.tube.end(), TubeStretch{});
  std::fill(follow.stages.time_s.begin(), follow.stages.time_s.end(), 0.0F);
  follow.stages.lap_most_s = 0.0;
  const ContractVerification made = followed(plan, &lies);
  const ContractVerdicts& now = made.certificate.verdicts;
  EXPECT_EQ(now.verdict, expected.verdicts.verdict);
  EXPECT_EQ(now.begin, expected.verdicts.begin);
  EXPECT_EQ(now.group, expected.verdicts.group);
  EXPECT_EQ(now.group_time_s, expected.verdicts.group_time_s);
  const FollowProof& proved = *made.certificate.follow;
  EXPECT_EQ(proved.leaf_stage, expected.follow->leaf_stage);
  EXPECT_EQ(proved.stages.time_s, expected.follow->stages.time_s);
  EXPECT_EQ(proved.stages.lap_most_s, expected.follow->stages.lap_most_s);
  EXPECT_EQ(widest_of(proved.tube).distance_m, widest_of(expected.follow->tube).distance_m);
  EXPECT_GT(made.resumed->dropped, 0U);
}

TEST(ContractResume, AProofOfFollowingGoesOnAsSuch) {
  for (const bool closed : {true, false}) {
    Plan plan =
        closed ? plan_along(ellipse_to_follow(), 32, 30) : plan_along(line_to_follow(), 30, 15);
    EarlierContractProof earlier{followed(plan, nullptr).certificate, "earlier"};
    ASSERT_TRUE(earlier.certificate.follow);
    const ContractVerification made = followed(plan, &earlier);
    ASSERT_TRUE(made.resumed && made.following);
    EXPECT_GT(made.resumed->decided, 1000U);
    EXPECT_EQ(made.resumed->dropped, 0U);
    EXPECT_EQ(made.certificate.follow->leaf_stage.size(), made.certificate.verdicts.leaves());
    expect_nothing_believed(plan, earlier.certificate, made.certificate);
    earlier.certificate.follow->path.vertices_m[1].x += 0.5;
    EXPECT_NE(difference(earlier.certificate, made.certificate).find("another line"),
              std::string::npos);
    std::get<PathMission>(*plan.record.mission).accept = PathAccept::touch;
    EXPECT_THROW(static_cast<void>(followed(plan, &earlier)), InputError);
  }
}

}  // namespace
}  // namespace fairway
