#include "fairway/run/flight_costs.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <variant>

#include "fairway/base/parallel.hpp"
#include "fairway/run/clearance.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/run/stratified_states.hpp"

namespace fairway {
namespace {

using nlohmann::json;

double one(const MeasuredFlight&) { return 1.0; }
double length_m_of(const MeasuredFlight& f) { return f.result.length_m; }
double hundreds_of_m(const MeasuredFlight& f) { return f.measures.turning.length_m / 100.0; }

/// `part` and `of` of the flights that were flown and for which `counts`.
template <typename Counts, typename Part, typename Of>
RateTotals totals_over(const MeasuredFlights& flown, const Counts& counts, const Part& part,
                       const Of& of) {
  RateTotals totals;
  totals.part.resize(flown.flights.size());
  totals.of.resize(flown.flights.size());
  for (std::size_t i = 0; i < flown.flights.size(); ++i) {
    const MeasuredFlight& flight = flown.flights[i];
    if ((!flown.flown.empty() && !flown.flown[i]) || !counts(flight, i)) continue;
    totals.part[i] = part(flight);
    totals.of[i] = of(flight);
  }
  return totals;
}

template <typename Counts, typename Part, typename Of>
SampledValue estimate_over(const MeasuredFlights& flown, const Counts& counts, const Part& part,
                           const Of& of) {
  const RateTotals totals = totals_over(
      flown, [&](const MeasuredFlight& f, std::size_t) { return counts(f); }, part, of);
  return ratio_of_totals(totals.part, totals.of);
}

bool has_joined(const MeasuredFlight& f) { return std::isfinite(f.measures.following.joined_s); }

PathCosts path_costs(const MeasuredFlights& flown) {
  PathCosts costs;
  costs.joined = estimate_over(
      flown, [](const MeasuredFlight& f) { return f.result.outcome == Outcome::reach; },
      [](const MeasuredFlight& f) { return has_joined(f) ? 1.0 : 0.0; }, one);
  costs.time_to_join_s = estimate_over(
      flown, has_joined, [](const MeasuredFlight& f) { return f.measures.following.joined_s; },
      one);
  costs.distance_m = estimate_over(
      flown, has_joined,
      [](const MeasuredFlight& f) {
        return f.measures.following.distance_mean_m * f.measures.following.measured_s;
      },
      [](const MeasuredFlight& f) { return f.measures.following.measured_s; });
  const Spread spread = flown.path->distance_m.spread();
  costs.distance_p95_m = spread.p95;
  costs.distance_worst_m = spread.worst;
  return costs;
}

json quantile_json(const QuantileEstimate& q) {
  const auto number = [](double value) { return std::isfinite(value) ? json(value) : json(); };
  return {{"value", number(q.value)},
          {"low", number(q.low)},
          {"high", number(q.high)},
          {"states", q.states}};
}

}  // namespace

namespace cost_rate {
const CostRate time_s{"time_s", [](const MeasuredFlight& f) { return f.result.time_s; }, one};
const CostRate length_m{"length_m", length_m_of, one};
const CostRate length_ratio{"length_ratio", length_m_of,
                            [](const MeasuredFlight& f) { return f.shortest_bound_m; }};
const CostRate turned_rad_per_100m{
    "turned_rad_per_100m", [](const MeasuredFlight& f) { return f.measures.turning.turned_rad; },
    hundreds_of_m};
const CostRate reversals_per_100m{
    "reversals_per_100m",
    [](const MeasuredFlight& f) { return static_cast<double>(f.measures.turning.reversals); },
    hundreds_of_m};
}  // namespace cost_rate

bool is_loop_to_follow(const Plan& plan) {
  const auto* path =
      plan.record.mission ? std::get_if<PathMission>(&*plan.record.mission) : nullptr;
  return path != nullptr && path->closed && path->accept == PathAccept::follow;
}

MeasuredFlights measure_flights(const Plan& plan, std::span<const State> states,
                                std::vector<bool> chosen, const LengthBound& bound,
                                const std::function<void(std::size_t done)>& progress) {
  constexpr std::size_t batch = 4000;  // between two calls of `progress`
  const FlightEngine engine(plan);
  const Clearance clearance(plan);
  MeasuredFlights flown;
  flown.flights.resize(states.size());
  flown.flown = std::move(chosen);
  flown.bound_name = bound.name;
  std::optional<PathMeter> meter;
  if (engine.path() != nullptr) {
    meter.emplace(*engine.path(), plan.vehicle.speed_mps, 0.5 * plan.grid.cell_m);
    flown.path.emplace();
  }
  const bool follows = is_loop_to_follow(plan);
  std::mutex mutex;
  const auto measure = [&](std::size_t i, PathSpreads* spreads) {
    MeasuredFlight& measured = flown.flights[i];
    measured.shortest_bound_m = bound.length_m(states[i]);
    measured.result = engine.fly(states[i], i);
    // Who is trapped flies for ever, and costs nothing that is told.
    if (measured.result.outcome != Outcome::reach) return;
    const Flight flight = meter ? engine.record(states[i], i, one_lap) : engine.track(states[i], i);
    measured.measures = {flight.turning, flight.onward, {}};
    if (meter && flight.onward.after != After::none) {
      measured.measures.following = meter->measure(flight, spreads);
    }
    measured.succeeds = !follows || flight.onward.after == After::follow;
    measured.clearance_m = clearance.least_along(flight);
  };
  for (std::size_t first = 0; first < states.size(); first += batch) {
    const std::size_t count = std::min(batch, states.size() - first);
    for_ranges(count, 64, [&](std::size_t begin, std::size_t end) {
      std::optional<PathSpreads> spreads;
      if (meter) spreads.emplace();
      for (std::size_t i = first + begin; i < first + end; ++i) {
        if (!flown.flown.empty() && !flown.flown[i]) continue;
        measure(i, spreads ? &*spreads : nullptr);
      }
      if (!spreads) return;
      const std::lock_guard lock(mutex);
      flown.path->distance_m.merge(spreads->distance_m);
      flown.path->heading_rad.merge(spreads->heading_rad);
    });
    if (progress) progress(first + count);
  }
  return flown;
}

RateTotals totals_of(const CostRate& rate, const MeasuredFlights& flown,
                     const std::vector<bool>& among) {
  return totals_over(
      flown,
      [&](const MeasuredFlight& f, std::size_t i) {
        return f.succeeds && (among.empty() || among[i]);
      },
      rate.part, rate.of);
}

std::vector<double> clearances_of(const MeasuredFlights& flown, const std::vector<bool>& among) {
  std::vector<double> clearances;
  for (std::size_t i = 0; i < flown.flights.size(); ++i) {
    const bool counts = flown.flights[i].succeeds && (among.empty() || among[i]);
    if (counts) clearances.push_back(flown.flights[i].clearance_m);
  }
  return clearances;
}

FlightCosts flight_costs(const MeasuredFlights& flown) {
  const auto all = [](const MeasuredFlight&) { return true; };
  const auto rate = [&](const CostRate& of) {
    const RateTotals totals = totals_of(of, flown);
    return ratio_of_totals(totals.part, totals.of);
  };
  FlightCosts costs;
  for (const Outcome outcome : outcomes_in_order) {
    costs.outcome[static_cast<std::size_t>(outcome)] = estimate_over(
        flown, all,
        [&](const MeasuredFlight& f) { return f.result.outcome == outcome ? 1.0 : 0.0; }, one);
  }
  costs.succeeds = estimate_over(
      flown, all, [](const MeasuredFlight& f) { return f.succeeds ? 1.0 : 0.0; }, one);
  costs.states = costs.succeeds.states;
  costs.time_s = rate(cost_rate::time_s);
  costs.length_m = rate(cost_rate::length_m);
  costs.length_ratio = rate(cost_rate::length_ratio);
  costs.shortest_bound = flown.bound_name;
  costs.turned_rad_per_100m = rate(cost_rate::turned_rad_per_100m);
  costs.reversals_per_100m = rate(cost_rate::reversals_per_100m);
  costs.clearance_p05_m = quantile_of(clearances_of(flown), 0.05);
  costs.clearance_median_m = quantile_of(clearances_of(flown), 0.5);
  if (flown.path) costs.path = path_costs(flown);
  return costs;
}

FlightCosts costs_over_all_states(const Plan& plan, std::size_t strata, std::uint64_t seed) {
  std::vector<bool> ground(plan.grid.size());
  for (std::size_t i = 0; i < ground.size(); ++i) {
    ground[i] = plan.region[i] == Region::free || plan.region[i] == Region::buffer;
  }
  const std::vector<State> states = stratified_states(plan.grid, ground, strata, seed);
  return flight_costs(measure_flights(plan, states, {}, line_around_obstacles(plan)));
}

json estimate_json(const SampledValue& e) {
  const bool known = std::isfinite(e.value);
  return {{"value", known ? json(e.value) : json()},
          {"standard_error", known ? json(e.standard_error) : json()},
          {"states", e.states}};
}

json flight_costs_json(const FlightCosts& c) {
  json outcomes = json::object();
  for (const Outcome outcome : outcomes_in_order) {
    outcomes[name_of(outcome)] = estimate_json(c.outcome[static_cast<std::size_t>(outcome)]);
  }
  json path;
  if (c.path) {
    path = {{"joined", estimate_json(c.path->joined)},
            {"time_to_join_s", estimate_json(c.path->time_to_join_s)},
            {"distance_m", estimate_json(c.path->distance_m)},
            {"distance_p95_m", c.path->distance_p95_m},
            {"distance_worst_m", c.path->distance_worst_m}};
  }
  return {{"states", c.states},
          {"outcome", std::move(outcomes)},
          {"succeeds", estimate_json(c.succeeds)},
          {"time_s", estimate_json(c.time_s)},
          {"length_m", estimate_json(c.length_m)},
          {"length_ratio", estimate_json(c.length_ratio)},
          {"shortest_bound", c.shortest_bound},
          {"turned_rad_per_100m", estimate_json(c.turned_rad_per_100m)},
          {"reversals_per_100m", estimate_json(c.reversals_per_100m)},
          {"clearance_p05_m", quantile_json(c.clearance_p05_m)},
          {"clearance_median_m", quantile_json(c.clearance_median_m)},
          {"path", std::move(path)}};
}

}  // namespace fairway
