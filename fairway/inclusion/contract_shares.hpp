// How many states are proved under a contract, and what the others wait for: measured by sampled
// states, equally many in each ordinary cell, each answered by contract_answer.
//
// Properties that always hold: each sum of shares is 1, or 0 when there are no such cells; the
// result depends on the arguments alone, not on threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/inclusion/contract_modes.hpp"
#include "fairway/inclusion/inclusion_prover.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// Shares by Verdict; of the undecided ones some are at risk: a behaviour that fails is known.
struct ContractShares {
  std::array<double, verdict_count> all{};   ///< cells that are neither obstacle nor target
  std::array<double, verdict_count> free{};  ///< of these, the safe-start cells
  std::array<double, verdict_count> buffer{};
  std::array<double, verdict_count> usable{};  ///< of the cells that the mission can use
  /// Of all, by the first mode that is proved to reach; empty: there is one mode.
  std::vector<double> reach_by_mode;
  double at_risk = 0.0;  ///< of all; all[undecided] holds it
  double at_risk_free = 0.0;
  std::size_t samples = 0;
  std::size_t usable_samples = 0;
  double worst_time_s = 0.0;  ///< largest bound of a sampled state proved to reach
};

/// A place that undecided states wait for.
struct Choke {
  Cell cell;
  Trouble why = Trouble::mixed;
  double share = 0.0;  ///< of all states
};

struct ContractSurvey {
  ContractShares shares;
  std::vector<Choke> chokes;  ///< most costly first
};

struct SurveyOptions {
  std::size_t samples = 40000;  ///< at least 1000, and one in each cell
  std::uint64_t seed = 1;
  std::size_t most_chokes = 20;
  /// For behaviours that fail, and for chokes; else only in cells that the mission can use.
  bool search_all = true;
};

/// Whether a behaviour that fails from this state is known; called for undecided states, by
/// several threads at once, with the number of the row of cells that the state is in.
using IsAtRisk = std::function<bool(const State& state)>;

/// `is_free`: safe starts; `is_usable`: cells that the mission can use, where enough states are
/// sampled however few they are; [cells]. `modes`: mode 0 first, of which `prover` is; at risk is
/// who may fail under it. `make_search`: called once for each thread's rows.
[[nodiscard]] ContractSurvey survey(const Flow& flow, const std::vector<bool>& is_free,
                                    const std::vector<bool>& is_usable,
                                    std::span<const ContractMode> modes,
                                    const InclusionProver& prover, double speed_least_mps,
                                    const SurveyOptions& options,
                                    const std::function<IsAtRisk()>& make_search);

}  // namespace fairway
