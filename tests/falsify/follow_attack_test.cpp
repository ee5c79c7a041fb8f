// The attack on following finds nothing in what is proved, and what is wrong in a proof that says
// more than that.
#include "tests/falsify/follow_attack.hpp"

#include <gtest/gtest.h>

#include "fairway/run/contract_verification.hpp"
#include "fairway/verify/testing/plans_along_paths.hpp"

namespace fairway {
namespace {

ContractCertificate certificate_along(const PathMission& path, int nx, int ny) {
  ContractVerifyOptions options;
  options.samples = 1000;
  options.find_witnesses = false;
  return verify_contract(plan_along(path, nx, ny), "plan", RegionOfInterest{}, contract_to_follow(),
                         options, [](const std::string&) {})
      .certificate;
}

TEST(FollowAttack, FindsNothingInWhatIsProved) {
  const ContractCertificate closed = certificate_along(ellipse_to_follow(), 32, 30);
  const FollowAttackTotals round = attack_following(closed, 200, 1);
  EXPECT_EQ(round.wrong(), 0U) << round.line() << round.stories.front();
  EXPECT_GE(round.laps, 3 * round.flights);
  const FollowAttackTotals on =
      attack_following(certificate_along(line_to_follow(), 30, 15), 200, 1);
  EXPECT_EQ(on.wrong(), 0U) << on.line();
  EXPECT_GE(on.flights, 200U);
}

TEST(FollowAttack, FindsWhatIsWrong) {
  ContractCertificate c = certificate_along(ellipse_to_follow(), 32, 30);
  const FollowProof proved = *c.follow;
  for (TubeStretch& stretch : c.follow->tube) stretch.distance_m *= 0.1F;
  EXPECT_GT(attack_following(c, 60, 1).strayed, 0U);
  c.follow = proved;
  for (TubeStretch& stretch : c.follow->tube) stretch.off_rad *= 0.1F;
  EXPECT_GT(attack_following(c, 60, 1).strayed, 0U);
  c.follow = proved;
  c.follow->stages.lap_most_s *= 0.3;
  EXPECT_GT(attack_following(c, 60, 1).late, 0U);
  c.follow = proved;
  c.follow->stages.lap_least_s *= 3.0;
  EXPECT_GT(attack_following(c, 60, 1).late, 0U);
  c.follow = proved;
  for (float& time_s : c.verdicts.group_time_s) time_s *= 0.0F;  // joins at once
  EXPECT_GT(attack_following(c, 60, 1).strayed, 0U);
}

}  // namespace
}  // namespace fairway
