// What a vehicle within a contract may do next: the steps that the contract allows it at a state,
// each admissible for its whole length.
//
// Sharper turns and wider ones, to either side, straight on, and a side held or not: of each kind
// one, for some command that may be in force. Steps keep a margin from all thresholds, so that
// proved_ends accepts them. Where the contract allows nothing by a margin (without any error, at a
// border between commands), a step is offered that follows the command of the vehicle's own cell:
// evidence, not proof.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/base/short_list.hpp"
#include "fairway/behaviour/behaviour_flight.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/verify/flow.hpp"

namespace fairway {

/// A vehicle on its way.
struct BehaviourState {
  Vec2 place;
  Vec2 unit{1.0, 0.0};
  double heading_rad = 0.0;  ///< in (-pi, pi]
  int held = 0;              ///< the side of a turn that it keeps: +1 left, -1 right, 0 none

  static BehaviourState of(const State& s) {
    return {s.position_m, s.heading.unit(), s.heading.rad(), 0};
  }
};

struct BehaviourChoice {
  BehaviourStep step;
  BehaviourState end;
  bool proved = true;  ///< admissible by a margin
};

using BehaviourChoiceList = ShortList<BehaviourChoice, 9>;

/// Sharp turns have the least radius, wide ones the greatest.
enum class StepKind : std::uint8_t { left_sharp, left_wide, straight, right_wide, right_sharp };
inline constexpr std::size_t step_kinds = 5;

class BehaviourChoices {
 public:
  /// `step_m`: the length of whole steps, limited to a share of the cell and of the radius; 0: half
  /// of that limit, or less. Wind is taken as calm, which the contract allows. Keeps references to
  /// the arrays that `flow` points to.
  BehaviourChoices(const Flow& flow, const VehicleContract& contract, double step_m = 0.0);

  /// At least one.
  void list(const BehaviourState& state, BehaviourChoiceList& choices) const;

  /// Those of the first kind, in this order, that the contract allows; no others are looked at.
  void list_first(const BehaviourState& state, const std::array<StepKind, step_kinds>& order,
                  BehaviourChoiceList& choices) const;

  /// What a step meets: target when any position of it may be in one, else the kind of the cell
  /// that its end lies in by a margin, else ordinary.
  CellKind met(Vec2 from, Vec2 to) const;

  /// The kind of the cell that a place lies in by a margin; ordinary when there is none.
  CellKind surely_in(Vec2 place) const;

  const Flow& flow() const { return flow_; }
  const VehicleContract& contract() const { return contract_; }
  const std::vector<float>& commands() const { return commands_; }  ///< filled_commands
  double step_m() const { return step_m_; }

 private:
  friend class ChoicesAt;

  static constexpr int lengths = 14;  ///< of steps: halves of halves
  /// A turn of a whole step.
  struct StepTurn {
    double radius_m;
    double angle_rad;
    double cosine;
    double sine;
  };

  Flow flow_;
  VehicleContract contract_;
  std::vector<float> commands_;
  std::vector<bool> near_goal_;  ///< a target is among the nine cells around
  double step_m_;
  double margin_m_;
  std::array<std::vector<StepTurn>, lengths> turns_;  ///< with radii of the range's ends
};

}  // namespace fairway
