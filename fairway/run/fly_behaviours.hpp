// Behaviours within a vehicle contract, flown from many starts: what some vehicle that keeps the
// contract may do under a plan. Evidence, but where a flight proves a failure (behaviour/
// proved_ends.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/behaviour/behaviour_pilot.hpp"
#include "fairway/map/earth_frame.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/simulate/flight_measures.hpp"
#include "fairway/simulate/flight_statistics.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway {

struct BehaviourRequest {
  VehicleContract contract;
  std::size_t behaviours = 40;         ///< from each start
  std::vector<Adversary> adversaries;  ///< take turns; not empty
  std::uint64_t seed = 1;
  bool record = false;                        ///< keep the pieces of the worst flight of each start
  std::function<void(std::size_t)> progress;  ///< called with the number of starts done
};

/// What the behaviours from one start came to.
struct StartOutcomes {
  OutcomeCounts counts;
  bool proved_failure = false;  ///< one that fails is proved to be within the contract
};

struct FlownBehaviours {
  VehicleContract contract;
  std::vector<Adversary> adversaries;
  std::size_t each = 0;
  std::vector<StartOutcomes> outcomes;  ///< of each start
  std::vector<Flight> worst;            ///< of each start: one that fails, when there is one
};

/// In parallel; the result depends on no number of threads. The first guided flight of a start is
/// that of a search for one that fails.
[[nodiscard]] FlownBehaviours fly_behaviours(const Plan& plan, std::span<const State> starts,
                                             const BehaviourRequest& request);

/// "greedy", or all of them for "all"; empty when nothing has the name.
[[nodiscard]] std::vector<Adversary> adversaries_of(const std::string& name);

/// A line for each start while there are few, those that fail first, then one for all. `drawn`:
/// where the starts were drawn from, " from ..."; empty: nowhere.
[[nodiscard]] std::string behaviour_words(const FlownBehaviours& flown,
                                          const std::string& drawn = {});

[[nodiscard]] nlohmann::json behaviour_json(const FlownBehaviours& flown,
                                            const EarthFrame* earth = nullptr);

}  // namespace fairway
