// The flights a scenario asks for.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fairway/plan/plan.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/run/fly_many.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

/// Recorded are the given ones, then the first `simulate.random`.
struct ScenarioFlights : ManyFlights {
  std::size_t given = 0;      ///< how many of the starts stand in the scenario
  std::vector<State> starts;  ///< given, then random

  std::span<const State> given_starts() const { return std::span(starts).first(given); }
  std::span<const FlightResult> given_results() const { return std::span(results).first(given); }
  std::span<const FlightResult> random_results() const { return std::span(results).subspan(given); }
  std::span<const FlightMeasures> random_measures() const {
    return std::span(measures).subspan(given);
  }
};

/// simulate.states, then simulate.states_deg. Throws InputError at their keys when one lies outside
/// the grid, or is in degrees and the map is not georeferenced.
[[nodiscard]] std::vector<State> given_states(const Scenario& scenario, const Plan& plan);

/// Flies max(simulate.random, simulate.sample) random safe starts and the given ones, and measures
/// them; the random ones' steps along a path are pooled. Flights of path missions are followed for
/// one lap beyond their first goal cell; those to a goal with a heading are given their last leg.
/// Throws as given_states() does. `engine`: exact, of `plan`;
/// `after_s`: what the run will take afterwards.
[[nodiscard]] ScenarioFlights fly_scenario(const Scenario& scenario, const Plan& plan,
                                           const FlightEngine& engine, const StageClock& clock,
                                           double after_s);

}  // namespace fairway
