#include "reproduce/measures.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/report/flight_series.hpp"
#include "fairway/simulate/flight_statistics.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway::reproduce {
namespace {

/// Piecewise linear value at `t`, between the series' ends.
double value_at(const ChartSeries& series, double t) {
  const auto after = std::upper_bound(series.x.begin(), series.x.end(), t);
  if (after == series.x.begin()) return series.y.front();
  if (after == series.x.end()) return series.y.back();
  const auto i = static_cast<std::size_t>(after - series.x.begin());
  const double t0 = series.x[i - 1];
  const double t1 = series.x[i];
  return series.y[i - 1] + (series.y[i] - series.y[i - 1]) * (t - t0) / (t1 - t0);
}

}  // namespace

HeadingMeasures heading_measures(const Flight& flight, double speed_mps, double window_s) {
  require(speed_mps > 0.0 && window_s > 0.0, "a speed and a window are positive");
  HeadingMeasures measures;
  if (flight.segments.empty()) return measures;
  const bool starts_turning = flight.segments.front().curvature_per_m != 0.0;
  const FlightSegment& first = flight.segments.front();
  const double from_s = starts_turning ? first.time_s + first.length_m / speed_mps : first.time_s;
  double last_turn = 0.0;
  for (std::size_t i = starts_turning ? 1 : 0; i < flight.segments.size(); ++i) {
    const FlightSegment& piece = flight.segments[i];
    if (piece.curvature_per_m == 0.0 || piece.length_m == 0.0) continue;
    measures.turning_rad += std::abs(piece.curvature_per_m) * piece.length_m;
    if (piece.curvature_per_m * last_turn < 0.0) ++measures.reversals;
    last_turn = piece.curvature_per_m;
  }
  const ChartSeries heading = heading_over_time(flight, speed_mps, "");
  const double step_s = window_s / 40.0;
  double sum = 0.0;
  long count = 0;
  for (double t = from_s; t + window_s <= heading.x.back(); t += step_s, ++count) {
    const double rate = (value_at(heading, t + window_s) - value_at(heading, t)) / window_s;
    sum += rate * rate;
    measures.largest_rate_radps = std::max(measures.largest_rate_radps, std::abs(rate));
  }
  if (count > 0) measures.rms_rate_radps = std::sqrt(sum / static_cast<double>(count));
  return measures;
}

PathMeasures path_measures(const Flight& flight, double speed_mps, const PathMission& path,
                           double corner_reach_m, double step_m) {
  require(speed_mps > 0.0 && step_m > 0.0, "a speed and a step are positive");
  std::vector<Vec2> corners = path.vertices_m;
  if (!path.closed && corners.size() >= 2) {
    corners.erase(corners.begin());
    corners.pop_back();
  }
  PathMeasures measures;
  measures.corner_m.assign(corners.size(), 0.0);
  double sum = 0.0;
  double length_m = 0.0;
  double straight_sum = 0.0;
  double straight_length_m = 0.0;
  PathSample last;
  for (const PathSample& sample : sample_along_path(flight, path, speed_mps, step_m)) {
    const double off_m = sample.nearest.distance_m;
    measures.max_m = std::max(measures.max_m, off_m);
    bool at_corner = false;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      if (norm(sample.state.position_m - corners[c]) > corner_reach_m) continue;
      at_corner = true;
      measures.corner_m[c] = std::max(measures.corner_m[c], off_m);
    }
    const double part_m = sample.length_m - last.length_m;  // trapezoids from sample to sample
    const double area = 0.5 * (off_m + last.nearest.distance_m) * part_m;
    last = sample;
    sum += area;
    length_m += part_m;
    if (at_corner) continue;
    straight_sum += area;
    straight_length_m += part_m;
  }
  if (length_m > 0.0) measures.mean_m = sum / length_m;
  if (straight_length_m > 0.0) measures.mean_of_straights_m = straight_sum / straight_length_m;
  return measures;
}

}  // namespace fairway::reproduce
