// Flies behaviours within a contract by the thousand, to do harm: the adversaries of
// behaviour/behaviour_pilot.hpp, at a fraction of their cost. Where the kind of step that one wants
// follows from what it is after, kinds of steps are looked at in that order, until the contract
// allows one; only who goes by the guide looks at all of them.
#pragma once

#include <functional>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/behaviour_pilot.hpp"
#include "fairway/behaviour/failure_guide.hpp"

namespace fairway {

struct AttackRun {
  Outcome outcome = Outcome::trapped;  ///< trapped: it met no end
  double length_m = 0.0;
  bool stopped = false;  ///< by who watched it
  BehaviourState end;
};

/// Where the obstacle nearest to a place is.
class NearestObstacle {
 public:
  explicit NearestObstacle(const Flow& flow);
  /// The middle of its cell; `from` where there is none.
  Vec2 near(Vec2 from) const;

 private:
  Flow flow_;
  std::vector<int> row_;  ///< where cell_in_command finds it
};

class AttackPilot {
 public:
  /// All must outlive this.
  AttackPilot(const BehaviourChoices& choices, const FailureGuide& guide,
              const NearestObstacle& obstacles)
      : choices_(choices), guide_(guide), obstacles_(obstacles) {}

  /// Asked after every step, before what it meets ends the flight, with the length flown so far;
  /// true: the flight stops.
  using Watch =
      std::function<bool(const BehaviourState& from, const BehaviourChoice& step, double)>;

  /// For at most `limit_m`. Its steps are added to `steps`.
  AttackRun fly(const BehaviourState& start, Adversary adversary, Random& random, double limit_m,
                std::vector<BehaviourStep>& steps, const Watch& watch) const;

  const BehaviourChoices& choices() const { return choices_; }

 private:
  struct Mood;
  void renew(Mood& mood, const BehaviourState& state, Random& random) const;
  BehaviourChoice choose(const Mood& mood, const BehaviourState& state, Random& random) const;
  double enter_goal(BehaviourState state, std::vector<BehaviourStep>& steps) const;

  const BehaviourChoices& choices_;
  const FailureGuide& guide_;
  const NearestObstacle& obstacles_;
};

/// What ends a flight with a cell of this kind; the kind is not ordinary.
constexpr Outcome outcome_of(CellKind kind) {
  return kind == CellKind::target     ? Outcome::reach
         : kind == CellKind::obstacle ? Outcome::collide
                                      : Outcome::leave;
}

}  // namespace fairway
