#include "fairway/run/scenario_flights.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/map/earth_frame.hpp"
#include "fairway/simulate/start_states.hpp"

namespace fairway {
namespace {

void require_on_grid(const char* key, const State& s, const Scenario& scenario, const Grid& grid) {
  if (grid.contains(grid.cell_of(s.position_m))) return;
  throw InputError(scenario.place_of(key),
                   fmt::format("{}: {}", key, outside_text(s.position_m, grid)));
}

}  // namespace

std::vector<State> given_states(const Scenario& scenario, const Plan& plan) {
  std::vector<State> states = scenario.simulate.states;
  for (const State& s : states) require_on_grid("simulate.states", s, scenario, plan.grid);
  if (scenario.simulate.states_deg.empty()) return states;
  const char* key = "simulate.states_deg";
  const std::string where = scenario.place_of(key) + ": " + key;
  const EarthFrame earth(frame_in(plan.record), where);
  for (const EarthState& s : scenario.simulate.states_deg) {
    states.push_back(earth.state_of(s, where));
    require_on_grid(key, states.back(), scenario, plan.grid);
  }
  return states;
}

ScenarioFlights fly_scenario(const Scenario& scenario, const Plan& plan, const FlightEngine& engine,
                             const StageClock& clock, double after_s) {
  const SimulateRequest& asked = scenario.simulate;
  std::vector<State> starts = given_states(scenario, plan);
  const std::size_t given = starts.size();
  const std::size_t random = std::max(asked.random, asked.sample);
  for (const State& s : random_states(plan, StartRegion::safe_start, random, asked.seed)) {
    starts.push_back(s);
  }

  FlyOptions options;
  options.tracks = given + asked.random;
  options.follow = engine.holds() ? five_laps : one_lap;
  options.measure = true;
  options.pool_from = given;
  options.count_legs = true;
  options.progress = [&](std::size_t flown) {
    const double per_flight_s = clock.seconds() / static_cast<double>(flown);
    clock.tell(per_flight_s * static_cast<double>(starts.size() - flown) + after_s);
  };
  ManyFlights flown = fly_many(engine, starts, options);
  return {std::move(flown), given, std::move(starts)};
}

}  // namespace fairway
