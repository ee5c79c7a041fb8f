// What a short straight piece of a track meets first: a goal cell, an obstacle cell, the grid's
// edge.
#pragma once

#include <optional>

#include "fairway/plan/plan.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

struct ChordEvent {
  double fraction;  ///< of the chord
  Outcome outcome;
};

/// The event of being in a cell: leave outside the grid; none if the flight continues.
[[nodiscard]] std::optional<Outcome> outcome_in(const Plan& plan, Cell cell);

/// The first event of the chord from `a`, in whose cell the flight is, to `b`. The chord is shorter
/// than a cell, so it crosses at most one grid line of either direction. `passes_goals`: goal cells
/// are flown through.
[[nodiscard]] std::optional<ChordEvent> first_event(const Plan& plan, Vec2 a, Vec2 b,
                                                    bool passes_goals);

}  // namespace fairway
