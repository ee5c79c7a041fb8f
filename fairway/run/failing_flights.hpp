// Flights from states that fail, for pictures and the page.
#pragma once

#include <cstddef>
#include <vector>

#include "fairway/run/failing_states.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

/// Flights that fail, from one ground.
struct FailingFlights {
  StartGround ground = StartGround::safe_start;
  std::vector<Flight> flights;
};

/// From each ground, safe starts with a command first, and to each kind of failure (collide, leave,
/// trapped) at most `of_each` flights: those that the run has flown first, then the longest, since
/// the longer a flight, the less its start shows how it ends. Undecided states whose flight fails
/// count. A ground without any is left out.
[[nodiscard]] std::vector<FailingFlights> failing_flights(const ExactFlights& flights,
                                                          const std::vector<FailingState>& failing,
                                                          std::size_t of_each);

/// All of them, in their order.
[[nodiscard]] std::vector<Flight> all_flights(const std::vector<FailingFlights>& grounds);

}  // namespace fairway
