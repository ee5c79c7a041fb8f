// The attack on plans with modes finds nothing in what is proved, and what is wrong in a proof that
// says more than that.
#include "tests/falsify/mode_attack.hpp"

#include <gtest/gtest.h>

#include <utility>

#include <tbb/global_control.h>

#include "fairway/verify/ask_modes.hpp"
#include "fairway/verify/certify.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/testing/street_plan.hpp"
#include "tests/falsify/wide_modal_flight.hpp"

namespace fairway {
namespace {

/// A plan with what is proved of it; `certified` may be spoilt.
struct Proved {
  Plan plan = street_plan(4);
  PlanFlow held{plan};
  Certified certified;

  Proved() {
    CertifyOptions options;
    options.samples = 2000;
    options.last_level = 12;
    certified = certify(held.flow(), held.is_free, options, {}, {}, plan.further_rad());
  }
  ProofView view() const {
    return {held.flow(), certified.sections.view(), static_cast<int>(plan.further_modes()),
            plan.mode_heading_rad.data(), certified.further.view()};
  }
};

ModeAttackTotals attacked(const Proved& proved, std::uint64_t hand_overs) {
  ModeAttackOptions options;
  options.hand_overs = hand_overs;
  options.states = 60000;
  options.wrong_enough = 1;
  return attack_modes(proved.view(), options);
}

bool is_reach(std::uint8_t verdict) { return verdict == static_cast<std::uint8_t>(Verdict::reach); }

TEST(ModeAttack, FindsNothingInWhatIsProved) {
  const Proved proved;
  const ModeAttackTotals totals = attacked(proved, 8000);
  EXPECT_EQ(totals.wrong(), 0U) << totals.line() << totals.stories.front();
  EXPECT_GE(totals.hand_overs, 8000U);
  EXPECT_GE(totals.changes, totals.hand_overs);
  EXPECT_GT(totals.by_proof, 500U);
  EXPECT_GT(totals.states, totals.flights + 1000);  // beside what is not proved, too
}

TEST(ModeAttack, DoesNotDependOnTheNumberOfThreads) {
  const Proved proved;
  const std::string many = attacked(proved, 2000).line();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(attacked(proved, 2000).line(), many);
}

TEST(ModeAttack, FindsAHandOverToAModeThatDoesNotBring) {
  Proved proved;
  // Back into mode 0, wherever a leaf is.
  for (std::uint8_t& next : proved.certified.further.next_mode) next = 0;
  const ModeAttackTotals totals = attacked(proved, 3000);
  EXPECT_GT(totals.contradictions, 5U) << totals.line();
}

TEST(ModeAttack, FindsAHandOverThatIsLeftOut) {
  Proved proved;
  for (std::uint8_t& next : proved.certified.further.next_mode) next = no_mode;
  ModeAttackOptions options;
  options.states = 20000;
  options.wrong_enough = 1;
  const ModeAttackTotals totals = attack_modes(proved.view(), options);
  EXPECT_GT(totals.contradictions, 5U) << totals.line();
}

TEST(ModeAttack, FindsALeafThatReachesTooFar) {
  // Every leaf begins a little before where it was proved: only states beside it can tell.
  Proved proved;
  SectionVerdicts& further = proved.certified.further;
  int moved = 0;
  for (std::size_t s = 0; s + 1 < further.first.size(); ++s) {
    for (std::uint32_t i = further.first[s] + 1; i < further.first[s + 1]; ++i) {
      if (!is_reach(further.verdict[i]) || is_reach(further.verdict[i - 1])) continue;
      further.begin[i] = further.begin[i - 1] + (further.begin[i] - further.begin[i - 1]) / 2;
      ++moved;
    }
  }
  ASSERT_GT(moved, 20);
  const ModeAttackTotals totals = attacked(proved, 20000);
  EXPECT_GT(totals.contradictions, 0U) << totals.line();
}

TEST(ModeAttack, FindsABoundThatIsTooShort) {
  Proved proved;
  for (float& time_s : proved.certified.further.time_s) time_s *= 0.9F;
  const ModeAttackTotals totals = attacked(proved, 3000);
  EXPECT_GT(totals.late, 5U) << totals.line();
  EXPECT_EQ(totals.contradictions, 0U) << totals.line();
}

TEST(ModeAttack, FliesInManyBitsAsInDoubles) {
  const Proved proved;
  const ProofView view = proved.view();
  const WideModalFlights wide(view);
  // Away from the goal in the street: into the square by mode 1, and back.
  const VerdictSet found = ask_mode(view, 1, 20.0, 25.0, 0.0);
  ASSERT_EQ(found.only(), Verdict::reach);
  ASSERT_NE(ask_mode(view, 0, 20.0, 25.0, 0.0).only(), Verdict::reach);
  const WideJudgement judged = wide.judge({20.0, 25.0, 0.0, 1, found.time_s});
  EXPECT_FALSE(judged.contradicted || judged.late || judged.unknown) << judged.ends;
  EXPECT_TRUE(wide.judge({20.0, 25.0, 0.0, 0, found.time_s}).contradicted);
  EXPECT_TRUE(wide.judge({20.0, 25.0, 0.0, 1, 0.1}).late);
}

}  // namespace
}  // namespace fairway
