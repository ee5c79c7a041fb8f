#include "fairway/run/prove_under_contract.hpp"

#include <gtest/gtest.h>

namespace fairway {
namespace {

ProvedUnderContract proved_with(double reach, double collide, double leave, double at_risk,
                                double undecided) {
  ProvedUnderContract proved;
  ContractShares& s = proved.verification.survey.shares;
  s.samples = 1'000'000;
  const auto set = [&](Verdict verdict, double share) {
    s.all[static_cast<std::size_t>(verdict)] = share;
  };
  set(Verdict::reach, reach);
  set(Verdict::collide, collide);
  set(Verdict::leave, leave);
  set(Verdict::undecided, undecided);
  s.at_risk = at_risk;
  return proved;
}

TEST(ProveUnderContract, FindingsAddUpWithReachFirstThenBadNews) {
  const Plan plan;
  const auto found = findings(plan, proved_with(0.8, 0.05, 0.03, 0.04, 0.12));
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].share, "80.0 %");
  EXPECT_EQ(found[0].what,
            "are proved to reach the goal whatever the vehicle does within its contract");
  EXPECT_EQ(found[1].share, "8.0 %") << "collide and leave";
  EXPECT_EQ(found[2].share, "4.0 %") << "at risk";
  EXPECT_EQ(found[3].share, "8.0 %") << "undecided, without those at risk";
  for (const Finding& finding : found) EXPECT_EQ(finding.of, "all states");
}

TEST(ProveUnderContract, AShareOfZeroHasNoLineButThatOfStatesThatReach) {
  const Plan plan;
  EXPECT_EQ(findings(plan, proved_with(1.0, 0.0, 0.0, 0.0, 0.0)).size(), 1U);
  const auto none = findings(plan, proved_with(0.0, 0.0, 0.0, 1.0, 1.0));
  ASSERT_EQ(none.size(), 2U);
  EXPECT_EQ(none[0].share, "0 %");
}

TEST(ProveUnderContract, NotesNameTheCheckAndAtMostTwoChokes) {
  ProvedUnderContract proved = proved_with(0.8, 0.0, 0.0, 0.0, 0.2);
  proved.verification.certificate.grid = {14, 12, -3.0, 5.0, 6.0};
  for (const int ix : {1, 2, 3}) {
    proved.verification.survey.chokes.push_back({{ix, 0}, Trouble::mixed, 0.01 * (4 - ix)});
  }
  const std::string notes = notes_of(proved);
  EXPECT_NE(notes.find("NOT checked"), std::string::npos);
  EXPECT_NE(notes.find("3.00 % of all states wait for (6, 8)"), std::string::npos) << notes;
  EXPECT_NE(notes.find("(12, 8)"), std::string::npos);
  EXPECT_EQ(notes.find("(18, 8)"), std::string::npos);
  proved.checked = true;
  EXPECT_EQ(notes_of(proved).find("NOT checked"), std::string::npos);
}

TEST(ProveUnderContract, ALimitThatEndedTheProofIsWarnedAbout) {
  ProvedUnderContract proved = proved_with(0.5, 0.0, 0.0, 0.0, 0.5);
  EXPECT_FALSE(limit_warning(proved));
  proved.verification.stopped_by_limit = true;
  EXPECT_TRUE(limit_warning(proved));
}

}  // namespace
}  // namespace fairway
