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
  int most_states = 1000;  ///< from which steps are tried in one search, where the guide says that
                           ///< failure is possible
  int most_beyond = 40;    ///< the same where it says nothing
  int searches = 1;        ///< with other orders of the steps
  int flights = 12;        ///< of adversaries, after them; an eighth where the guide says nothing
};

/// Best first, by the levels of the guide; then flights of adversaries. Holds memory that it uses
/// again: one for each thread.
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
