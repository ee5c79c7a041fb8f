#include "fairway/run/scenario_flights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/simulate/exact_flight.hpp"
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

double length_m(const PathMission& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.vertices_m.size(); ++i) {
    length += norm(path.vertices_m[i] - path.vertices_m[i - 1]);
  }
  if (path.closed) length += norm(path.vertices_m.front() - path.vertices_m.back());
  return length;
}

/// The last leg of every flight that reaches: kept with the recorded ones, counted for all.
void steer_to_heading(const ExactFlights& flights, const FinalLegs& legs, ScenarioFlights& flown) {
  FinalLegTally tally;
  constexpr std::size_t batch = 1000;
  for (std::size_t done = 0; done < flown.starts.size(); done += batch) {
    std::vector<Flight> part(std::min(batch, flown.starts.size() - done));
    for_ranges(part.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (flown.results[done + i].outcome != Outcome::reach) continue;
        part[i] = flights.record(flown.starts[done + i]);
        part[i].final_leg = legs.leg_of(part[i]);
      }
    });
    for (std::size_t i = 0; i < part.size(); ++i) {
      tally.add(part[i], legs.goal());
      if (done + i < flown.recorded.size()) {
        flown.recorded[done + i].final_leg = std::move(part[i].final_leg);
      }
    }
  }
  flown.final_legs = tally;
}

}  // namespace

Flight recorded_flight(const ExactFlights& flights, const Plan& plan, const Mission& mission,
                       const State& start) {
  const auto* path = std::get_if<PathMission>(&mission);
  if (path == nullptr) return flights.record(start);
  const float cost_m = plan.cost_m[plan.grid.index(plan.grid.cell_of(start.position_m))];
  const double approach_m = std::isfinite(cost_m) ? static_cast<double>(cost_m) : 0.0;
  return flights.follow(start, approach_m + length_m(*path));
}

ScenarioFlights fly_scenario(const Scenario& scenario, const Plan& plan, const Mission& mission,
                             const StageClock& clock, double after_s) {
  require_on_grid(scenario, plan.grid);
  const SimulateRequest& asked = scenario.simulate;
  ScenarioFlights flown;
  flown.given = asked.states.size();
  flown.starts = asked.states;
  const std::size_t random = std::max(asked.random, asked.sample);
  for (const State& s : random_states(plan, StartRegion::safe_start, random, asked.seed)) {
    flown.starts.push_back(s);
  }

  const ExactFlights flights(plan);
  constexpr std::size_t batch = 1000;
  const std::span<const State> starts(flown.starts);
  while (flown.results.size() < starts.size()) {
    const std::size_t done = flown.results.size();
    for (const FlightResult& result :
         flights.fly_all(starts.subspan(done, std::min(batch, starts.size() - done)))) {
      flown.results.push_back(result);
    }
    const double per_flight_s = clock.seconds() / static_cast<double>(flown.results.size());
    clock.tell(per_flight_s * static_cast<double>(starts.size() - flown.results.size()) + after_s);
  }
  const std::size_t to_record = std::min(flown.given + asked.random, starts.size());
  flown.recorded.resize(to_record);
  for_ranges(to_record, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      flown.recorded[i] = recorded_flight(flights, plan, mission, starts[i]);
    }
  });
  if (const auto goal = goal_pose_of(plan)) {
    steer_to_heading(flights, FinalLegs(plan, *goal), flown);
  }
  return flown;
}

}  // namespace fairway
