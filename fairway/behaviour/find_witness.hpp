// The search for a witness: one behaviour within a contract that fails from a given state.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/behaviour_flight.hpp"
#include "fairway/behaviour/failure_guide.hpp"

namespace fairway {

struct WitnessEffort {
  int most_states = 3000;  ///< from which steps are tried, of those that the guide says may fail
  int most_beyond = 60;    ///< the same of those from which it found no way
};

/// Best first, by the levels of the guide. Holds memory that it uses again: one for each thread.
class WitnessSearch {
 public:
  /// Both must outlive this.
  WitnessSearch(const BehaviourChoices& choices, const FailureGuide& guide);
  ~WitnessSearch();
  WitnessSearch(const WitnessSearch&) = delete;
  WitnessSearch& operator=(const WitnessSearch&) = delete;

  /// A flight that is_witness accepts, or none: which proves nothing. The same state, effort and
  /// seed find the same.
  [[nodiscard]] std::optional<BehaviourFlight> find(const State& start,
                                                    const WitnessEffort& effort = {},
                                                    std::uint64_t seed = 1);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace fairway
