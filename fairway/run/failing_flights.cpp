#include "fairway/run/failing_flights.hpp"

#include <algorithm>
#include <utility>

namespace fairway {
namespace {

/// Also of a trapped flight, whose result has no length.
double flown_m(const Flight& flight) {
  double length_m = 0.0;
  for (const FlightSegment& piece : flight.segments) length_m += piece.length_m;
  return length_m;
}

}  // namespace

std::vector<Flight> longest_failing(const ExactFlights& flights,
                                    const std::vector<FailingState>& failing, std::size_t of_each) {
  std::vector<Flight> longest;
  for (const Verdict verdict : verdicts_in_order) {
    if (!fails(verdict)) continue;
    std::vector<State> starts;
    for (const FailingState& state : failing) {
      if (state.verdict == verdict) starts.push_back(state.start);
    }
    std::vector<Flight> flown = flights.record_all(starts);
    std::stable_sort(flown.begin(), flown.end(),
                     [](const Flight& a, const Flight& b) { return flown_m(a) > flown_m(b); });
    if (flown.size() > of_each) flown.resize(of_each);
    for (Flight& flight : flown) longest.push_back(std::move(flight));
  }
  return longest;
}

}  // namespace fairway
