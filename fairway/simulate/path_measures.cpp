#include "fairway/simulate/path_measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

/// Calls visit(time_s, state) at times step_s apart, from the start on, while visit returns true.
template <typename Visit>
void in_even_steps(const Flight& flight, double speed_mps, double step_s, const Visit& visit) {
  std::size_t step = 0;
  for (std::size_t i = 0; i < flight.segments.size(); ++i) {
    const FlightSegment& piece = flight.segments[i];
    // In wind a piece's time is not its length by the plan's speed.
    const double end_s = i + 1 < flight.segments.size() ? flight.segments[i + 1].time_s
                         : flight.onward.time_s > 0.0   ? flight.onward.time_s
                         : std::isfinite(flight.result.time_s)
                             ? flight.result.time_s
                             : piece.time_s + piece.length_m / speed_mps;
    const double time_s = end_s - piece.time_s;
    for (; static_cast<double>(step) * step_s < end_s; ++step) {
      const double at_s = static_cast<double>(step) * step_s;
      const double share = std::clamp((at_s - piece.time_s) / time_s, 0.0, 1.0);
      if (!visit(at_s, state_at(piece, share * piece.length_m))) return;
    }
  }
}

}  // namespace

PathMeter::PathMeter(const PathMission& path, double speed_mps, double step_m)
    : locator_(path), speed_mps_(speed_mps), step_s_(step_m / speed_mps) {
  require(speed_mps > 0.0 && step_m > 0.0, "speed and step are positive");
}

PathFollowing PathMeter::measure(const Flight& flight, PathSpreads* spreads) const {
  PathFollowing found;
  const bool closed = locator_.path().closed;
  const double length_m = locator_.length_m();
  std::size_t steps = 0;
  std::size_t piece = 0;  // from one step to the next it changes little
  std::size_t on_path = 0;
  double progress_m = 0.0;
  double last_along_m = 0.0;
  in_even_steps(flight, speed_mps_, step_s_, [&](double time_s, const State& state) {
    const PathPoint nearest = locator_.nearest(state.position_m, piece);
    const bool is_on = locator_.on_path(state, piece);
    if (!is_on && steps == 0) return true;
    if (steps > 0 && !closed && nearest.along_m >= length_m) return false;
    if (steps == 0) {
      found.joined_s = time_s;
    } else {
      const double moved_m = nearest.along_m - last_along_m;
      progress_m += closed ? std::remainder(moved_m, length_m) : moved_m;
    }
    last_along_m = nearest.along_m;
    const double off_rad = std::abs(state.heading.turn_to(nearest.tangent));
    ++steps;
    on_path += is_on ? 1 : 0;
    found.distance_mean_m += nearest.distance_m;
    found.heading_mean_rad += off_rad;
    found.distance_worst_m = std::max(found.distance_worst_m, nearest.distance_m);
    found.heading_worst_rad = std::max(found.heading_worst_rad, off_rad);
    if (spreads != nullptr) {
      spreads->distance_m.add(nearest.distance_m);
      spreads->heading_rad.add(off_rad);
    }
    return true;
  });
  if (steps == 0) return found;
  const auto all = static_cast<double>(steps);
  found.measured_s = all * step_s_;
  found.on_path_share = static_cast<double>(on_path) / all;
  found.distance_mean_m /= all;
  found.heading_mean_rad /= all;
  found.laps = progress_m / length_m;
  return found;
}

}  // namespace fairway
