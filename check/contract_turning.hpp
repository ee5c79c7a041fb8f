// Sets that turn to one side: the heading only grows (or falls), so it serves as the clock. In a
// step of a few degrees all places of a set lie in one polygon, and in every part that it meets,
// `choices_in` (contract_rules.hpp) says what may happen: align, turn on, turn back.
#pragma once

#include <vector>

#include "check/contract_following.hpp"
#include "check/contract_rules.hpp"

namespace fairway_check {

/// Follows those that roam (contract_flight.hpp).
class Roaming {
 public:
  virtual ~Roaming() = default;
  virtual void roam(Cell part, const Shape& at, double least, double most, const Past& past) = 0;
};

class TurningSets {
 public:
  TurningSets(Following& following, Roaming& roaming) : following_(following), roaming_(roaming) {}

  /// Those at `at` with headings in [least, most] turn to one side: 1 left, -1 right.
  void add(const Shape& at, int turn, double least, double most, Memory memory, const Box& sure,
           const Past& past);
  /// Until none is left, or nothing further can matter.
  void follow();

 private:
  struct Turning {
    Shape at{};
    Shape joining{};     ///< until the clock is `joined`, others begin here
    int turn = 1;        ///< 1 left, -1 right
    double clock = 0.0;  ///< the heading is turn * clock
    double joined = 0.0;
    Memory memory{};
    Past past{};
    Box sure = everywhere;
  };
  /// A part that a set meets in a step.
  struct Near {
    Cell part;
    Shape there;
    bool is_reached;
  };
  struct Met {
    Cell part{};
    bool stays = false;  ///< the set may turn on in it
  };
  /// Those that turn back in a part.
  struct Return {
    Cell part{};
    Turning set{};
  };

  bool advance(Turning& set);
  double step_before_changes(const Turning& set, const Box& swept, double step) const;
  bool align_all(const Turning& set, double step, const Past& past);
  void meet(const Turning& set, double step, const Shape& swept, const Past& past, Memory& memory);
  void meet_part(const Turning& set, double step, Cell part, const Shape& there, const Past& past,
                 Memory& memory);
  bool is_followed_beyond(const Turning& set, double end, Cell part, const Shape& there);
  void turn_back(const Turning& set, double end, Cell part, const Shape& there, Memory memory,
                 const Past& past);
  bool part_from(Turning& set);

  Following& following_;
  Roaming& roaming_;
  std::vector<Turning> waiting_;
  std::vector<Return> returns_;
  std::vector<Near> near_;  ///< what a step sweeps
  std::vector<Met> met_;
};

}  // namespace fairway_check
