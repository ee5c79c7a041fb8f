// The attack on plans with modes under a contract finds nothing in what is proved, and what is
// wrong in proofs that say more than that.
#include "tests/falsify/contract_mode_attack.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <tbb/global_control.h>

#include "fairway/vehicle/modes.hpp"
#include "tests/falsify/contract_mode_flight.hpp"
#include "tests/falsify/contract_mode_proof.hpp"
#include "tests/falsify/step_crossings.hpp"

namespace fairway {
namespace {

constexpr std::uint64_t trials = 3;

/// Proved for estimates with these shares of the error that they have.
ContractCertificate proved(const ContractModeTrial& trial, double share_of_place,
                           double share_of_heading) {
  const EstimateError error = EstimateError::of(trial.contract);
  return prove_with_modes(trial.plan, trial.contract,
                          {share_of_place * error.place_m, share_of_heading * error.heading_rad},
                          {});
}

ContractCertificate proved(std::uint64_t seed) {
  return proved(contract_mode_trial(seed), 1.0, 1.0);
}

ContractModeAttackTotals attacked(const ContractCertificate& certificate, std::uint64_t flights) {
  ContractModeAttackOptions options;
  options.flights = flights;
  return attack_contract_modes(certificate, options);
}

TEST(ContractModeAttack, FindsNothingInWhatIsProved) {
  ContractModeAttackTotals all;
  for (std::uint64_t seed = 0; seed < trials; ++seed) {
    all.add(attacked(proved(seed), 6000));
  }
  EXPECT_EQ(all.wrong(), 0U) << all.line() << all.stories.front();
  EXPECT_GE(all.flights, trials * 6000);
  EXPECT_GT(all.aimed, all.flights / 3);
  EXPECT_GT(all.at_once, all.aimed / 8);
  EXPECT_GT(all.through, all.flights / 5);
  EXPECT_GE(all.changes, all.through);
  EXPECT_GT(all.by_loop, 50U);
  EXPECT_LT(all.unproved, all.flights / 200);  // the search wastes little
}

TEST(ContractModeAttack, DoesNotDependOnTheNumberOfThreads) {
  const ContractCertificate certificate = proved(0);
  const std::string many = attacked(certificate, 3000).line();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(attacked(certificate, 3000).line(), many);
}

TEST(ContractModeAttack, FindsHandOversThatAreGrownTooLittle) {
  const auto wrong = [](double share_of_place, double share_of_heading) {
    std::uint64_t found = 0;
    for (std::uint64_t seed = 0; seed < trials; ++seed) {
      ContractModeTrial trial = contract_mode_trial(seed);
      if (share_of_heading < share_of_place) {  // with an error of heading that counts
        trial.contract.command_error_m = 0.06;
        trial.contract.heading_error_rad = 0.15;
      }
      found += attacked(proved(trial, share_of_place, share_of_heading), 8000).wrong();
    }
    return found;
  };
  EXPECT_GT(wrong(0.0, 0.0), 0U);   // estimates taken for exact
  EXPECT_GT(wrong(0.25, 1.0), 0U);  // half the error of place, not twice
  EXPECT_GT(wrong(1.0, 0.0), 0U);   // that of heading left out
}

TEST(ContractModeAttack, FindsAHandOverToAModeThatDoesNotBring) {
  ContractCertificate certificate = proved(0);
  for (std::uint8_t& next : certificate.mode_verdicts.group_next_mode) {
    if (next != no_mode && next > 0) next = 0;
  }
  const ContractModeAttackTotals totals = attacked(certificate, 5000);
  EXPECT_GT(totals.contradictions, 0U) << totals.line();
}

TEST(ContractModeAttack, FindsAHandOverThatIsLeftOut) {
  ContractCertificate certificate = proved(0);
  for (std::uint8_t& next : certificate.mode_verdicts.group_next_mode) next = no_mode;
  const ContractModeAttackTotals totals = attacked(certificate, 5000);
  EXPECT_GT(totals.wrong(), 0U) << totals.line();
}

TEST(ContractModeAttack, FindsABoundThatIsTooShort) {
  ContractCertificate certificate = proved(0);
  for (float& time_s : certificate.mode_verdicts.group_time_s) time_s *= 0.05F;
  const ContractModeAttackTotals totals = attacked(certificate, 5000);
  EXPECT_GT(totals.late, 0U) << totals.line();
}

TEST(ContractModeAttack, StepsAreCutWhereTheyCrossLines) {
  Random random(5);
  int crossed = 0;
  for (int k = 0; k < 500; ++k) {
    const State start{{random.uniform(0.0, 4.0), random.uniform(0.0, 4.0)},
                      Heading::from_rad(random.uniform(-pi, pi))};
    const BehaviourState from = BehaviourState::of(start);
    const int turn = static_cast<int>(random.below(3)) - 1;
    const double angle = random.uniform(0.1, 1.2);
    BehaviourStep step{turn, turn == 0 ? 0.0 : random.uniform(1.0, 3.0), turn == 0 ? 2.0 : 0.0,
                       Heading::from_rad(from.heading_rad + turn * angle).rad()};
    const double all = whole_step(from, step);
    double before = 0.0;
    int lines = 0;
    for_crossings(
        from, step, {0.0, 0.0}, 1.0, [](double, bool, double, double) { return true; },
        [&](double along) {
          const Vec2 p = within_step(from, step, along).place;
          EXPECT_LT(std::min(std::abs(p.x - std::round(p.x)), std::abs(p.y - std::round(p.y))),
                    1e-9);
          EXPECT_GE(along, before);
          before = along;
          ++lines;
          return false;
        });
    // By small pieces, how often the cell changes; within a piece both may.
    int changes = 0;
    Vec2 at = from.place;
    for (int piece = 1; piece <= 4000; ++piece) {
      const Vec2 p = within_step(from, step, all * piece / 4000.0).place;
      changes += std::floor(p.x) != std::floor(at.x) ? 1 : 0;
      changes += std::floor(p.y) != std::floor(at.y) ? 1 : 0;
      at = p;
    }
    EXPECT_EQ(lines, changes);
    crossed += lines;
  }
  EXPECT_GT(crossed, 300);
}

}  // namespace
}  // namespace fairway
