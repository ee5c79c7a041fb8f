// Attacks verdicts under a vehicle contract with behaviours that keep it: from every state with a
// proved verdict some that want another outcome. Each contradiction is flown with bounds
// (behaviour/proved_ends.hpp), so it is a fault of the proof. A flight with another end than
// claimed is first cut where it surely meets something between the ends of its steps.
//
// What is left out, so that there are more flights: most of them (all but one in `whole_one_in`)
// end where they come, with no side held, to a state of which the same verdict is claimed, once
// they have flown for some turning radii; whether that claim is right is asked by attacks from
// there. Flights from states that are proved to be trapped go for an eighth of the usual length at
// which a flight counts as trapped, but for those few; those from states that reach, until the
// bound of time is over. Every other flight takes steps of twice the usual length, which meet an
// obstacle only where they end.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fairway/vehicle/contract.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/verdict.hpp"
#include "tests/falsify/progress.hpp"

namespace fairway {

struct ContractClaim {
  Verdict verdict = Verdict::undecided;
  double time_bound_s = 0.0;  ///< of `reach`
};

/// Called from several threads at once.
using ContractVerdictOf = std::function<ContractClaim(const State&)>;

struct ContractAttackOptions {
  std::uint64_t flights = 100000;  ///< at least
  int each = 24;                   ///< flights from one state
  std::uint64_t seed = 1;
  int halvings = 24;  ///< towards a boundary of what is proved, at most
  std::uint64_t whole_one_in = 8;
  ContractVerdictOf claimed_there;  ///< where flights end early; none: the one that is attacked
  AttackProgress progress = go_on_silently;
};

struct ContractAttackTotals {
  std::uint64_t states = 0;  ///< asked about
  std::uint64_t aimed = 0;   ///< of the flights, from beside a boundary
  std::uint64_t flights = 0;
  std::uint64_t handed_on = 0;  ///< of the flights, ended where the same was claimed
  std::uint64_t searched = 0;   ///< of the flights, found by a search
  std::uint64_t contradictions = 0;
  std::uint64_t late = 0;  ///< reached, but later than the bound
  std::uint64_t refuted =
      0;  ///< not another end: looked at closely, between steps, the claimed one
  std::uint64_t unproved =
      0;  ///< another outcome, by a flight that is not proved to keep the contract
  std::array<std::uint64_t, verdict_count> by_verdict{};
  std::vector<std::string> stories;  ///< of the first contradictions: state, seed, adversary

  void add(const ContractAttackTotals& other);
  std::uint64_t wrong() const { return contradictions + late; }
  std::string line() const;
};

/// Half of the flights start beside a boundary between proved and unproved states, found by
/// bisection; the others at states drawn at random. All cores.
[[nodiscard]] ContractAttackTotals attack(const std::string& name, const Flow& flow,
                                          const VehicleContract& contract,
                                          const ContractVerdictOf& verdict_of,
                                          const ContractAttackOptions& options);

}  // namespace fairway
