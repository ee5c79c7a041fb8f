// What a recorded behaviour certainly ends with: the check behind every `at_risk`. It re-computes a
// flight from its steps alone, whoever found them, and shares no code with the search.
//
// Theorem. If is_witness accepts a flight, then some behaviour within the contract starts in its
// state and touches an obstacle, or leaves the grid, before it enters any goal cell.
//
// Lemmas, each a check of one step. Positions are known within `slack`, a bound on all rounding so
// far; headings are exact.
//   1. Near. A turn by an angle t < pi with radius R stays within R t^2 / 8 >= R (1 - cos(t / 2))
//   of
//      its chord. The point `look_ahead` ahead of the vehicle turns by the same angle about the
//      same centre, with radius sqrt(R^2 + look_ahead^2).
//   2. In force. The distance from a cell is a convex function, so along a chord it is greatest at
//      an end. If both ends are within command_error of points inside cell c, less the bound of 1
//      and slack, then some point inside c is within command_error during the whole step: the
//      command of c, give or take heading_error, may be in force throughout. With `own_cell`, that
//      point is the vehicle's own (or that ahead of it): then every ordinary cell that it may be
//      in during the step has to justify the step (in the others the flight has ended).
//   3. Turning. Let u be the angle from the heading to the command, counted in the direction of the
//      turn. It falls by the angle turned. If it does not fall below 0 the vehicle turns towards
//      the command throughout. The side is the one that rule 3 of the contract demands if u is at
//      most hold_side (then nothing is remembered afterwards), or at most pi + side_uncertain while
//      the other side is not held, or less than 2 pi - hold_side while this side is held. The side
//      is held afterwards if u is still greater than hold_side.
//   4. Straight. Within heading_error of the command of c, flying straight is allowed.
//   5. End. The last position lies inside an obstacle cell, or outside the grid, by more than
//      slack, and the boxes around all steps, grown by 1 and slack, meet no goal cell.
// Wind is at most wind_mps, so calm air is within the contract, and the flight is in calm air.
// Numbers: sines and cosines within 2^-50, angles within 2^-46; what is nearer to a threshold is
// refused.
#pragma once

#include <cstdint>
#include <span>

#include "fairway/behaviour/behaviour_flight.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// What a flight may end with.
struct ProvedEnds {
  std::uint8_t ends = 0;   ///< bit v: Verdict v; it surely ends with one of them. 0: not proved
  double length_m = 0.0;   ///< flown, at most
  bool admissible = true;  ///< every step is proved to be within the contract

  bool may_be(Verdict v) const { return (ends >> static_cast<unsigned>(v) & 1U) != 0; }
  bool surely(Verdict v) const { return ends == 1U << static_cast<unsigned>(v); }
  /// Surely with an obstacle, or outside the grid, and never in a goal cell before.
  bool surely_fails() const {
    return ends != 0 && !may_be(Verdict::reach) && !may_be(Verdict::undecided);
  }
};

/// `commands`: filled_commands of the flow. Whatever the steps hold, nothing is thrown.
[[nodiscard]] ProvedEnds proved_ends(const Flow& flow, std::span<const float> commands,
                                     const VehicleContract& contract,
                                     const BehaviourFlight& flight);

/// Whether the flight proves that a behaviour within the contract fails from its start.
[[nodiscard]] bool is_witness(const Flow& flow, std::span<const float> commands,
                              const VehicleContract& contract, const BehaviourFlight& flight);

}  // namespace fairway
