#include "fairway/simulate/flight_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

RegionCounts count_by_region(const Plan& plan, std::span<const State> starts,
                             std::span<const FlightResult> results) {
  require(starts.size() == results.size(), "one result per start");
  RegionCounts counts;
  const Grid& grid = plan.grid;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Outcome outcome = results[i].outcome;
    counts.all.add(outcome);
    const Vec2 p = starts[i].position_m;
    if (!(p.x >= grid.x0_m && p.x < grid.x0_m + grid.width_m() && p.y >= grid.y0_m &&
          p.y < grid.y0_m + grid.height_m())) {
      continue;
    }
    const Cell found = grid.cell_of(p);  // rounding may round up at the last cell's end
    const std::size_t cell =
        grid.index({std::min(found.ix, grid.nx - 1), std::min(found.iy, grid.ny - 1)});
    switch (plan.region[cell]) {
      case Region::buffer:
        counts.buffer.add(outcome);
        break;
      case Region::goal:
        counts.goal.add(outcome);
        break;
      case Region::obstacle:
        counts.obstacle.add(outcome);
        break;
      case Region::free:
        counts.safe_start.add(outcome);
        if (std::isfinite(plan.cost_m[cell])) counts.safe_start_finite_cost.add(outcome);
        break;
    }
  }
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
