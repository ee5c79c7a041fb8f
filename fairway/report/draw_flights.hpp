// Flights over a plan: every piece an exact arc or straight line, a dot and a tick at the start.
//
// Without names, colour and dash show the outcome and the legend counts them over all flights.
// With names (one per flight), colour and dash show the name, as in a figure that compares plans.
// Pieces in further modes of the plan (docs/modes.md) are dashed over the flight's own line, and
// the legend counts flights that have any; where none has, nothing differs. Final legs are drawn
// over the flights with their own strokes: solid where the leg is the shortest path, dashed where
// it is another approach; a cross where no approach is clear.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fairway/inclusion/follow_proof.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/report/picture.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

struct FlightPictureOptions {
  std::string title = {};
  std::optional<Mission> mission = {};  ///< the goal point and heading, or the path, drawn below
  const FollowProof* follow = nullptr;  ///< the tube of the path, drawn below; or none
  std::vector<std::string> names = {};  ///< empty, or one per flight; equal names share a style
  int most_drawn = 200;                 ///< lines drawn; a legend line says when there are more
  double frame_pt = 420.0;
  double pixels_per_pt = 2.0;
};

/// Flights without segments are counted and their start is drawn. Throws PreconditionViolation as
/// draw_plan does.
[[nodiscard]] Picture draw_flights(const Plan& plan, std::span<const Flight> flights,
                                   const FlightPictureOptions& options);

}  // namespace fairway
