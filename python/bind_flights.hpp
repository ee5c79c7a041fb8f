// Many flights as Python holds them.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "binding.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/run/fly_many.hpp"
#include "fairway/simulate/flight_measures.hpp"

namespace fairway::python {

/// Many flights under one plan. They are flown again when their tracks are asked for: a flight
/// depends on its start and its index alone.
struct Flights {
  std::shared_ptr<HeldPlan> plan;
  std::shared_ptr<const FlightEngine> engine;  ///< of the plan
  std::vector<State> starts;
  std::optional<FollowFor> follow;
  std::vector<FlightResult> results = {};
  std::vector<FlightMeasures> measures = {};
  std::optional<Followed> followed = {};

  std::vector<Flight> recorded(std::size_t first, std::size_t count) const {
    const auto part = std::span(starts).subspan(first);
    FlyOptions options;
    options.follow = follow;
    options.tracks = std::min(count, part.size());
    options.first_index = first;
    return fly_many(*engine, part.first(options.tracks), options).recorded;
  }
};

/// The classes Trajectory and Flights.
void bind_flights(py::module_& m);

}  // namespace fairway::python
