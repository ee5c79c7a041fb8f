// Flights of a vehicle under a contract from mode to mode, as docs/modes.md says, out to do harm.
//
// By leaves: the behaviours of attack_pilot.hpp, in long steps. Where one crosses a leaf that is
// handed over in time, it changes, for then every estimate is near enough; some change earlier,
// where one of a few estimates as wrong as allowed says so. In which mode a change ends is what
// such an estimate tells, too.
//
// By the vehicle's own loop: a ContractPilot that is told wrong estimates steers in small steps.
// Its estimates are better than the contract asks for by what a step moves, since it is asked at
// steps only.
#pragma once

#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/behaviour/behaviour_flight.hpp"
#include "fairway/simulate/flight.hpp"
#include "tests/falsify/attacked_modes.hpp"

namespace fairway {

/// What is flown in one mode, and when it is to reach.
struct ModeStretch {
  int mode = 0;
  BehaviourFlight flight;
  double bound_s = 0.0;
};

struct ContractModeRun {
  std::vector<ModeStretch> stretches;  ///< empty: nothing is claimed of the start
  Outcome outcome = Outcome::trapped;  ///< trapped: it met no end until it was late
  bool handed_on = false;              ///< ended where the same is claimed
  bool late = false;

  int changes() const { return static_cast<int>(stretches.size()) - 1; }
};

struct ModeFlightManner {
  bool eager = false;           ///< changes early
  bool whole = false;           ///< goes to its end
  bool aims_at_change = false;  ///< is not ended before its first change
};

[[nodiscard]] ContractModeRun fly_by_leaves(const AttackedModes& modes, const State& start,
                                            int mode, double bound_s,
                                            const ModeFlightManner& manner, Random& random);

[[nodiscard]] ContractModeRun fly_by_loop(const AttackedModes& modes, const State& start,
                                          Random& random);

/// Whether a stretch comes upon a leaf that it would have to be handed over at, in time, or so near
/// one that this is not certain; found by small steps alone.
[[nodiscard]] bool passes_hand_over(const AttackedModes& modes, const ModeStretch& stretch);

}  // namespace fairway
