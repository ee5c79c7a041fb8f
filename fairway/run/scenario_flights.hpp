// The flights a scenario asks for, and the pictures and charts of them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fairway/plan/plan.hpp"
#include "fairway/run/final_legs.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

struct ScenarioFlights {
  std::size_t given = 0;                    ///< how many of the starts stand in the scenario
  std::vector<State> starts;                ///< given, then random
  std::vector<FlightResult> results;        ///< one per start
  std::vector<Flight> recorded;             ///< the given ones, then the first `simulate.random`
  std::optional<FinalLegTally> final_legs;  ///< of all starts, when the goal has a heading

  std::span<const FlightResult> given_results() const { return std::span(results).first(given); }
  std::span<const FlightResult> random_results() const { return std::span(results).subspan(given); }
};

/// A flight as it is recorded: for a path mission beyond its first goal cell, along the path.
/// `start` lies on the grid.
[[nodiscard]] Flight recorded_flight(const ExactFlights& flights, const Plan& plan,
                                     const Mission& mission, const State& start);

/// Flies max(simulate.random, simulate.sample) random safe starts and the given ones. Flights of
/// path missions are recorded beyond their first goal cell, along the path; those to a goal with a
/// heading are given their last leg. Throws InputError at simulate.states when one lies outside the
/// grid. `after_s`: what the run will take afterwards.
[[nodiscard]] ScenarioFlights fly_scenario(const Scenario& scenario, const Plan& plan,
                                           const Mission& mission, const StageClock& clock,
                                           double after_s);

}  // namespace fairway
