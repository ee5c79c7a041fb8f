#include "fairway/run/fly_many.hpp"

#include <algorithm>

#include "fairway/base/parallel.hpp"

namespace fairway {

ManyFlights fly_many(const FlightEngine& engine, std::span<const State> starts,
                     const FlyOptions& options) {
  constexpr std::size_t batch = 1000;  // between two calls of `progress`
  ManyFlights flown;
  flown.results.resize(starts.size());
  flown.recorded.resize(std::min(options.tracks, starts.size()));
  const bool count_legs = options.count_legs && engine.legs();
  if (count_legs) flown.final_legs.emplace();
  for (std::size_t first = 0; first < starts.size(); first += batch) {
    const std::size_t count = std::min(batch, starts.size() - first);
    std::vector<Flight> passing(count_legs ? count : 0);  // until their legs are counted
    const auto flight_of = [&](std::size_t i) -> Flight& {
      return i < flown.recorded.size() ? flown.recorded[i] : passing[i - first];
    };
    const auto fly = [&](std::size_t i) {
      const std::size_t index = options.first_index + i;
      const bool kept = i < flown.recorded.size();
      const bool recorded = kept || count_legs;
      if (recorded) {
        Flight& flight = flight_of(i);
        flight = engine.record(starts[i], index, options.track_end);
        flown.results[i] = flight.result;
        if (!kept) flight.segments = {};
      }
      if (!recorded || engine.goes_on(options.track_end)) {
        flown.results[i] = engine.fly(starts[i], index);
      }
    };
    for_ranges(count, 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = first + begin; i < first + end; ++i) fly(i);
    });
    for (std::size_t i = first; count_legs && i < first + count; ++i) {
      flown.final_legs->add(flight_of(i), engine.legs()->goal());
    }
    if (options.progress) options.progress(first + count);
  }
  return flown;
}

}  // namespace fairway
