// How many of a plan's undecided states are at risk: a behaviour within the contract that fails
// from there is known. States are asked in random order, so that a search that runs out of time has
// asked a fair sample.
//
// Properties that always hold: only what behaviour/proved_ends.hpp proves counts as at risk; the
// result depends on no number of threads, unless `go_on` ended the search.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/failure_guide.hpp"
#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/inclusion/contract_shares.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// The undecided states of a survey, gathered by several threads at once.
class UndecidedStates {
 public:
  /// For survey(): notes each state, and calls none at risk.
  [[nodiscard]] std::function<IsAtRisk()> gatherer();
  /// In an order that depends on the states and the seed alone.
  [[nodiscard]] std::vector<State> in_random_order(std::uint64_t seed);

 private:
  std::mutex adding_;
  std::vector<State> states_;
};

struct RiskCount {
  std::size_t asked = 0;  ///< states, of which `asked_free` are safe starts
  std::size_t asked_free = 0;
  std::size_t at_risk = 0;
  std::size_t at_risk_free = 0;
};

/// Takes a while to make: it follows all failures of the plan backwards.
class FailureSearch {
 public:
  /// `certificate` must outlive this.
  explicit FailureSearch(const ContractCertificate& certificate);

  /// Searches from each state while `go_on`, asked by several threads at once, says so.
  [[nodiscard]] RiskCount count(const std::vector<State>& states, std::uint64_t seed,
                                const std::function<bool()>& go_on) const;

 private:
  const ContractCertificate& certificate_;
  BehaviourChoices choices_;
  FailureGuide guide_;
};

/// Adds what a search of `states` found, scaled up to all of them when it ended early. False when
/// too few were asked to tell a share.
[[nodiscard]] bool add_at_risk(ContractShares& shares, std::size_t states, const RiskCount& found);

}  // namespace fairway
