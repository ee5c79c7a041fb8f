#include "fairway/run/fly_many.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

/// Computes what is reported of flights in addition to their outcomes. Threads may share it.
class Measuring {
 public:
  Measuring(const FlightEngine& engine, const FlyOptions& options, ManyFlights& flown)
      : options_(options), flown_(flown) {
    if (!options.measure) return;
    flown.measures.resize(flown.results.size());
    if (!flown.followed) return;
    const Plan& plan = engine.plan();
    meter_.emplace(*engine.path(), plan.vehicle.speed_mps, 0.5 * plan.grid.cell_m);
  }

  void add(std::size_t i, const Flight& flight) {
    if (!options_.measure) return;
    FlightMeasures& measures = flown_.measures[i];
    measures = {flight.turning, flight.onward, {}};
    if (!meter_ || flight.onward.after == After::none) return;
    PathSpreads steps;
    const bool pooled = i >= options_.pool_from;
    measures.following = meter_->measure(flight, pooled ? &steps : nullptr);
    if (!pooled) return;
    const std::lock_guard lock(mutex_);
    PathSpreads& spreads = flown_.followed->spreads;
    spreads.distance_m.merge(steps.distance_m);
    spreads.heading_rad.merge(steps.heading_rad);
  }

 private:
  const FlyOptions& options_;
  ManyFlights& flown_;
  std::optional<PathMeter> meter_;
  std::mutex mutex_;
};

}  // namespace

ManyFlights fly_many(const FlightEngine& engine, std::span<const State> starts,
                     const FlyOptions& options) {
  constexpr std::size_t batch = 1000;  // between two calls of `progress`
  ManyFlights flown;
  flown.results.resize(starts.size());
  flown.recorded.resize(std::min(options.tracks, starts.size()));
  const PathMission* path = engine.path();
  if (path != nullptr && options.follow) {
    flown.followed = {
        *options.follow, path->delta_position_m, path->delta_heading_rad, {}, engine.holds()};
  }
  const auto follow = flown.followed ? options.follow : std::nullopt;
  Measuring measuring(engine, options, flown);
  const bool count_legs = options.count_legs && engine.legs();
  if (count_legs) flown.final_legs.emplace();
  const bool all_recorded = count_legs || follow;
  for (std::size_t first = 0; first < starts.size(); first += batch) {
    const std::size_t count = std::min(batch, starts.size() - first);
    std::vector<Flight> passing(count_legs ? count : 0);  // until their legs are counted
    const auto flight_of = [&](std::size_t i) -> Flight& {
      return i < flown.recorded.size() ? flown.recorded[i] : passing[i - first];
    };
    const auto fly = [&](std::size_t i) {
      const std::size_t index = options.first_index + i;
      const bool kept = i < flown.recorded.size();
      if (!kept && !all_recorded && !options.measure) {
        flown.results[i] = engine.fly(starts[i], index);
        return;
      }
      Flight flight = kept || all_recorded ? engine.record(starts[i], index, follow)
                                           : engine.measure(starts[i], index);
      flown.results[i] = flight.result;
      measuring.add(i, flight);
      if (!kept) flight.segments = {};
      if (kept || count_legs) flight_of(i) = std::move(flight);
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
