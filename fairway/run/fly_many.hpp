// Many flights under a plan: the result of each, tracks of the first ones, and their last legs.
//
// Properties that always hold:
//   1. Flight i is the engine's flight from start i with index first_index + i. No result depends
//      on how many fly, on what is kept of them, or on the number of threads.
//   2. Each start is flown once, beyond its first goal cell too where it is followed.
// Memory: in addition to what is kept, the last legs of a thousand flights.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fairway/run/final_legs.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/simulate/flight_measures.hpp"
#include "fairway/simulate/path_measures.hpp"

namespace fairway {

struct FlyOptions {
  std::size_t tracks = 0;  ///< the first so many flights are recorded, with their last legs
  /// Flights of a path mission, or about a goal to hold at, are followed for so long, all of them,
  /// recorded or not.
  std::optional<FollowFor> follow = {};
  bool measure = false;         ///< turning of all flights, and how those followed keep to the path
  std::size_t pool_from = 0;    ///< the first start whose steps along the path are pooled
  bool count_legs = false;      ///< of all flights, recorded or not, where the engine has legs
  std::size_t first_index = 0;  ///< of the first start
  /// Called after each batch, on the calling thread, with the number flown so far. An exception
  /// ends the work. May be empty.
  std::function<void(std::size_t flown)> progress = {};
};

/// How flights of a path mission were followed.
struct Followed {
  FollowFor how;
  double delta_position_m = 0.0;  ///< of the mission (paper 1, Eq. 5)
  double delta_heading_rad = 0.0;
  PathSpreads spreads;  ///< of the pooled flights, when measured
  bool holds = false;   ///< about a goal, on a circle
};

struct ManyFlights {
  std::vector<FlightResult> results;        ///< one per start
  std::vector<FlightMeasures> measures;     ///< one per start, when measured
  std::optional<Followed> followed;         ///< when the flights were followed along a path
  std::vector<Flight> recorded;             ///< of the first starts
  std::optional<FinalLegTally> final_legs;  ///< of all starts, when counted
};

[[nodiscard]] ManyFlights fly_many(const FlightEngine& engine, std::span<const State> starts,
                                   const FlyOptions& options = {});

}  // namespace fairway
