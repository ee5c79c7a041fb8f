// Handing over from one mode of a plan to an earlier one, under a vehicle contract (docs/modes.md).
//
// The vehicle does not know its state exactly. It changes to the earlier mode where the state that
// it takes itself to be in lies within its error of a leaf that is handed over. That state lies
// within the same error of the true one. So a leaf is handed over when all states within *twice*
// the error of it are proved to reach under one earlier mode, with no side held.
#pragma once

#include <cstdint>
#include <span>

#include "fairway/base/vec2.hpp"
#include "fairway/inclusion/behaviour_flight.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/convex_set.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/inclusion/reach_boxes.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/vehicle/modes.hpp"

namespace fairway {

/// How far the state that a vehicle takes itself to be in is from the true one, at most.
struct EstimateError {
  double place_m = 0.0;
  double heading_rad = 0.0;

  static constexpr EstimateError of(const VehicleContract& contract) {
    return {contract.command_error_m, contract.heading_error_rad};
  }
};

struct ContractHandOver {
  std::uint8_t mode = no_mode;  ///< the first that is proved to reach from all states
  double time_s = 0.0;          ///< bound of the time to reach, from here
};

/// Of the leaf over places [lo, hi] of a side of an ordinary part of `own`, for the headings of its
/// arc. `earlier`: of the modes before, in order, their parts of the same cells and contract.
[[nodiscard]] ContractHandOver hand_over(const Parts& own, PartPlace part, PartSide side, double lo,
                                         double hi, const EstimateError& error,
                                         std::span<const ReachBoxes* const> earlier);

/// For the vehicle in a further mode, of parts `own` and with these verdicts: of the leaves that
/// are handed over and lie within `error` of the state that it takes itself to be in, the one with
/// the least bound, if that is `in_time_s` or less. `place`: in parts.
[[nodiscard]] ContractHandOver hand_over_near(const Parts& own,
                                              const ContractVerdictsView& verdicts, Vec2 place,
                                              double heading_rad, const EstimateError& error,
                                              double in_time_s);

/// Seconds within which every behaviour of a mode reaches that starts within `error` of a state and
/// holds no side; ReachBoxes::not_proved if there is no such bound.
[[nodiscard]] double time_around(const Parts& parts, const ContractVerdictsView& verdicts,
                                 double speed_least_mps, Vec2 place, double heading_rad,
                                 const EstimateError& error);

/// All places within `by` of the segment, as an octagon around it that holds them; in parts.
[[nodiscard]] ConvexSet grown_segment(const ConvexSet& segment, double by);

}  // namespace fairway
