// Follows every behaviour within a contract from a set of states, until each has met an end or
// crosses out of a part *aligned*: with its heading in the part's arc (contract_parts.hpp). What is
// reported holds everything that any behaviour may do (docs/trust.md, "The second theorem"):
//
//   aligned   The heading stays in the arc, so the way through the part lies in a cone.
//   turning   The heading only grows (or falls), so it serves as the clock: in a step of a few
//             degrees all places of the set lie in one polygon. In every part that the polygon
//             meets, `choices_in` says what may happen: align, turn on, turn back.
//   roaming   Where any command may be in force, or a behaviour may alternate between the sides,
//             only the least radius bounds it: within a part the heading changes by little.
#pragma once

#include "check/contract_following.hpp"
#include "check/contract_rules.hpp"
#include "check/contract_turning.hpp"

namespace fairway_check {

/// Follows one set after the other; not by two threads at once.
class Behaviours : private Roaming {
 public:
  Behaviours(const Parts& parts, const Contract& contract);
  Behaviours(const Behaviours&) = delete;
  Behaviours& operator=(const Behaviours&) = delete;

  /// All that leave the part aligned at [low, high] of a side.
  void follow_leaf(std::size_t part, int side, double low, double high, Sightings& sightings);
  /// At a place of `at`, from the corner of an ordinary part and in it, with a heading in
  /// [least, most]; no side in memory.
  void follow_states(std::size_t part, const Shape& at, double least, double most,
                     Sightings& sightings);
  /// At (x, y) in an ordinary part, from its corner; no side in memory.
  void follow_state(std::size_t part, double x, double y, double heading_rad, Sightings& sightings);

 private:
  void begin(Cell part, const Shape& at, double least, double most, Memory left, Memory right,
             const Box& sure, const Past& past);
  void roam(Cell part, const Shape& at, double least, double most, const Past& past) override;

  const Parts& parts_;
  Following following_;
  TurningSets turning_;
  double roaming_rad_;  ///< by which the heading may change in a part; NaN: any
};

}  // namespace fairway_check
