#include "fairway/simulate/flight_statistics.hpp"

#include <cmath>
#include <numeric>

#include "fairway/base/error.hpp"

namespace fairway {

std::size_t OutcomeCounts::total() const {
  return std::accumulate(by_outcome.begin(), by_outcome.end(), std::size_t{0});
}

double OutcomeCounts::share(Outcome outcome) const {
  const std::size_t n = total();
  return n == 0 ? 0.0 : static_cast<double>(of(outcome)) / static_cast<double>(n);
}

OutcomeCounts count_outcomes(std::span<const FlightResult> results) {
  OutcomeCounts counts;
  for (const FlightResult& result : results) counts.add(result.outcome);
  return counts;
}

std::vector<PathSample> sample_along_path(const Flight& flight, const PathMission& path,
                                          double speed_mps, double step_m) {
  require(speed_mps > 0.0 && step_m > 0.0, "speed and step are positive");
  std::vector<PathSample> samples;
  double before_m = 0.0;
  for (const FlightSegment& piece : flight.segments) {
    const auto steps = static_cast<std::size_t>(std::ceil(piece.length_m / step_m));
    for (std::size_t i = 0; i <= steps; ++i) {
      const double along_m =
          i == steps ? piece.length_m
                     : piece.length_m * static_cast<double>(i) / static_cast<double>(steps);
      PathSample sample;
      sample.state = state_at(piece, along_m);
      sample.length_m = before_m + along_m;
      sample.time_s = sample.length_m / speed_mps;
      sample.nearest = nearest_on_path(sample.state.position_m, path);
      sample.heading_error_rad = sample.state.heading.turn_to(sample.nearest.tangent);
      sample.on_path = on_path(sample.state, path);
      samples.push_back(sample);
    }
    before_m += piece.length_m;
  }
  return samples;
}

}  // namespace fairway
