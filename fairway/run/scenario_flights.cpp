#include "fairway/run/scenario_flights.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/simulate/start_states.hpp"

namespace fairway {
namespace {

void require_on_grid(const Scenario& scenario, const Grid& grid) {
  for (const State& s : scenario.simulate.states) {
    if (grid.contains(grid.cell_of(s.position_m))) continue;
    throw InputError(scenario.place_of("simulate.states"),
                     "simulate.states: " + outside_text(s.position_m, grid));
  }
}

}  // namespace

ScenarioFlights fly_scenario(const Scenario& scenario, const Plan& plan, const FlightEngine& engine,
                             const StageClock& clock, double after_s) {
  require_on_grid(scenario, plan.grid);
  const SimulateRequest& asked = scenario.simulate;
  const std::size_t given = asked.states.size();
  std::vector<State> starts = asked.states;
  const std::size_t random = std::max(asked.random, asked.sample);
  for (const State& s : random_states(plan, StartRegion::safe_start, random, asked.seed)) {
    starts.push_back(s);
  }

  FlyOptions options;
  options.tracks = given + asked.random;
  options.follow = one_lap;
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
