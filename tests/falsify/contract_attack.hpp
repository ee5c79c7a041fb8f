// Attacks verdicts under a vehicle contract with behaviours that keep it: from every state with a
// proved verdict some that want another outcome. Each contradiction is flown with bounds
// (behaviour/proved_ends.hpp), so it is a fault of the proof.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fairway/behaviour/behaviour_pilot.hpp"
#include "fairway/behaviour/failure_guide.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/verdict.hpp"

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
  int halvings = 24;  ///< towards a boundary of what is proved
};

struct ContractAttackTotals {
  std::uint64_t states = 0;  ///< asked about
  std::uint64_t aimed = 0;   ///< of the flights, from beside a boundary
  std::uint64_t flights = 0;
  std::uint64_t contradictions = 0;
  std::uint64_t late = 0;  ///< reached, but later than the bound
  std::uint64_t unproved =
      0;  ///< another outcome, by a flight that is not proved to keep the contract
  std::array<std::uint64_t, verdict_count> by_verdict{};
  std::vector<std::string> stories;  ///< of the first contradictions: state, seed, adversary

  void add(const ContractAttackTotals& other);
  std::string line() const;
};

/// Half of the flights start beside a boundary between proved and unproved states, found by
/// bisection; the others at states drawn at random. All cores.
[[nodiscard]] ContractAttackTotals attack(const std::string& name, const Flow& flow,
                                          const VehicleContract& contract,
                                          const ContractVerdictOf& verdict_of,
                                          const ContractAttackOptions& options);

}  // namespace fairway
