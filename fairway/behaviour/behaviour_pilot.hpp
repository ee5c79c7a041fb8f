// Flies one behaviour within a contract after the other, at random or to do harm.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/failure_guide.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

enum class Adversary : std::uint8_t {
  random,    ///< what it likes, for a while each
  greedy,    ///< towards some obstacle nearby
  circling,  ///< round one side for as long as it may
  guided     ///< down the levels of a FailureGuide
};
inline constexpr std::array adversaries_in_order{Adversary::random, Adversary::greedy,
                                                 Adversary::circling, Adversary::guided};

constexpr const char* name_of(Adversary adversary) {
  constexpr const char* names[]{"random", "greedy", "circling", "guided"};
  return names[static_cast<int>(adversary)];
}

/// How a behaviour went. Evidence, but where proved_ends agrees.
struct BehaviourRun {
  Outcome outcome = Outcome::trapped;  ///< trapped: it met no end within the limit
  double length_m = 0.0;
  bool proved = true;  ///< all steps were admissible by a margin
};

class BehaviourPilot {
 public:
  /// `choices` and `guide` must outlive this. Without a guide, `guided` flies at random.
  explicit BehaviourPilot(const BehaviourChoices& choices, const FailureGuide* guide = nullptr);

  /// For at most `limit_m`; 0: default_limit_m. With `steps`, they are recorded there. The same
  /// seed flies the same.
  BehaviourRun fly(const State& start, Adversary adversary, std::uint64_t seed,
                   double limit_m = 0.0, std::vector<BehaviourStep>* steps = nullptr) const;

  /// Ten times round the grid, and twenty circles.
  double default_limit_m() const;

 private:
  struct Mood;
  double enter_goal(BehaviourState state, std::vector<BehaviourStep>& steps) const;
  void renew(Mood& mood, const BehaviourState& state, Random& random) const;
  int pick(const Mood& mood, const BehaviourChoiceList& list, Random& random) const;

  const BehaviourChoices& choices_;
  const FailureGuide* guide_;
  std::vector<int> obstacle_row_;  ///< where cell_in_command finds the nearest obstacle
};

}  // namespace fairway
