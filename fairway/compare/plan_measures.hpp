// How good a plan is over all states: what is proved of them, and what flights from them cost.
#pragma once

#include <array>
#include <optional>

#include "fairway/run/estimate_of_pairs.hpp"
#include "fairway/run/flight_costs.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// By Verdict. Measured on sampled states, each answered as a query answers it.
using VerdictShares = std::array<SampledValue, verdict_count>;

struct ProvedShares {
  VerdictShares all{};         ///< of all states: in cells that are neither obstacle nor goal
  VerdictShares safe_start{};  ///< of those in the plan's safe-start cells
  VerdictShares buffer{};      ///< of those in its buffer cells
};

struct PlanMeasures {
  /// Of the exact vehicle. Without a certificate, of what its flights were seen to do, never
  /// undecided.
  ProvedShares exact;
  bool is_proved = false;                ///< false: only flown
  std::optional<ProvedShares> contract;  ///< where there is a contract certificate
  FlightCosts costs;                     ///< of the flights that succeed under this plan
};

}  // namespace fairway
