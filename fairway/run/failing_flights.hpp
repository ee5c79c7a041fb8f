// Flights from states that are proved to fail, for pictures and the page.
#pragma once

#include <cstddef>
#include <vector>

#include "fairway/run/verification.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

/// Of each kind of failure (collide, leave, trapped) the longest flights, longest first, at most
/// `of_each`: the longer a flight, the less its start shows how it ends.
[[nodiscard]] std::vector<Flight> longest_failing(const ExactFlights& flights,
                                                  const std::vector<FailingState>& failing,
                                                  std::size_t of_each);

}  // namespace fairway
