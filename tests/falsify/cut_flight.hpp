// Where a flight ends that was flown by steps: they may have passed a corner of an obstacle, or of
// a goal, between their ends.
#pragma once

#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/behaviour_flight.hpp"
#include "tests/falsify/step_crossings.hpp"

namespace fairway {

struct CutFlight {
  BehaviourFlight flight;
  CellKind end = CellKind::ordinary;  ///< what it surely is in at its end
};

/// The flight until it surely is in a cell that ends it, looked for by small pieces of its steps;
/// all of it where it never is.
inline CutFlight until_it_ends(const BehaviourChoices& choices, const BehaviourFlight& flight) {
  constexpr int pieces = 32;
  CutFlight until{{flight.start, {}}, CellKind::ordinary};
  BehaviourState at = BehaviourState::of(flight.start);
  for (const BehaviourStep& step : flight.steps) {
    const double all = whole_step(at, step);
    for (int k = 1; k < pieces; ++k) {
      const double along = all * k / pieces;
      const BehaviourState s = within_step(at, step, along);
      until.end = choices.surely_in(s.place);
      if (until.end == CellKind::ordinary) continue;
      until.flight.steps.push_back(shortened(step, along, s));
      return until;
    }
    until.flight.steps.push_back(step);
    at.place = at.place + move_of(step, at.heading_rad);
    at.heading_rad = step.heading_rad;
    at.unit = Heading::from_rad(at.heading_rad).unit();
    until.end = choices.surely_in(at.place);
    if (until.end != CellKind::ordinary) return until;
  }
  return until;
}

/// Whether the flight surely meets nothing for so many metres, and goes on beyond. `choices`: with
/// steps as long as those of the flight, or longer.
inline bool is_still_flying_at(const BehaviourChoices& choices, const BehaviourFlight& flight,
                               double most_m) {
  double flown_m = 0.0;
  Vec2 place = flight.start.position_m;
  double heading = flight.start.heading.rad();
  for (const BehaviourStep& step : flight.steps) {
    const Vec2 end = place + move_of(step, heading);
    if (choices.met(place, end) != CellKind::ordinary) return false;
    flown_m += length_of(step, heading);
    if (flown_m > most_m) return true;
    place = end;
    heading = step.heading_rad;
  }
  return false;
}

}  // namespace fairway
