// The prover of verdicts under a contract, as the attack asks it: by flights of single
// states, or by the quick look-ups that a vehicle's queries are.
#pragma once

#include <optional>

#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/inclusion/quick_lookup.hpp"
#include "tests/falsify/contract_attack.hpp"

namespace fairway {

class ContractProof {
 public:
  /// Keeps nothing of `flow`. `contract`: with look-ahead and wind, if it has them.
  ContractProof(const Flow& flow, const VehicleContract& contract, int per_cell, int last_level,
                double time_limit_s);

  ContractClaim claim(const State& state) const;
  ContractClaim quick_claim(const State& state) const;
  std::size_t leaves() const { return verdicts_.leaves(); }
  double undecided_share() const { return undecided_share_; }

 private:
  Grid grid_;
  VehicleContract over_ground_;
  Parts parts_;
  ContractVerdicts verdicts_;
  std::optional<QuickLookup> lookup_;
  double undecided_share_ = 1.0;
};

}  // namespace fairway
