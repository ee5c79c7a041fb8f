#include "fairway/run/failing_flights.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace fairway {
namespace {

struct Candidate {
  Flight flight;
  bool flown = false;
  double length_m = 0.0;
};

/// Also of a trapped flight, whose result has no length.
double flown_m(const Flight& flight) {
  double length_m = 0.0;
  for (const FlightSegment& piece : flight.segments) length_m += piece.length_m;
  return length_m;
}

/// From one ground, by outcome.
std::array<std::vector<Candidate>, outcome_codes> candidates(
    const ExactFlights& flights, const std::vector<FailingState>& failing, StartGround ground) {
  std::vector<State> starts;
  std::vector<bool> flown;
  for (const FailingState& state : failing) {
    if (state.ground != ground) continue;
    starts.push_back(state.start);
    flown.push_back(state.flown);
  }
  std::vector<Flight> recorded = flights.record_all(starts);
  std::array<std::vector<Candidate>, outcome_codes> found;
  for (std::size_t k = 0; k < recorded.size(); ++k) {
    const double length_m = flown_m(recorded[k]);
    auto& alike = found[static_cast<std::size_t>(recorded[k].result.outcome)];
    alike.push_back({std::move(recorded[k]), flown[k], length_m});
  }
  return found;
}

}  // namespace

std::vector<FailingFlights> failing_flights(const ExactFlights& flights,
                                            const std::vector<FailingState>& failing,
                                            std::size_t of_each) {
  std::vector<FailingFlights> grounds;
  for (const StartGround ground : start_grounds_in_order) {
    auto by_outcome = candidates(flights, failing, ground);
    FailingFlights chosen{ground, {}};
    for (const Outcome outcome : outcomes_in_order) {
      if (outcome == Outcome::reach) continue;
      auto& alike = by_outcome[static_cast<std::size_t>(outcome)];
      std::stable_sort(alike.begin(), alike.end(), [](const Candidate& a, const Candidate& b) {
        return std::pair(a.flown, a.length_m) > std::pair(b.flown, b.length_m);
      });
      if (alike.size() > of_each) alike.resize(of_each);
      for (Candidate& candidate : alike) chosen.flights.push_back(std::move(candidate.flight));
    }
    if (!chosen.flights.empty()) grounds.push_back(std::move(chosen));
  }
  return grounds;
}

std::vector<Flight> all_flights(const std::vector<FailingFlights>& grounds) {
  std::vector<Flight> all;
  for (const FailingFlights& ground : grounds) {
    all.insert(all.end(), ground.flights.begin(), ground.flights.end());
  }
  return all;
}

}  // namespace fairway
