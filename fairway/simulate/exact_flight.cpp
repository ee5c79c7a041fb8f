#include "fairway/simulate/exact_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/simulate/exact_flight_loop.hpp"
#include "fairway/simulate/exact_flight_record.hpp"

namespace fairway {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

FlightLimits ExactFlights::with_defaults(FlightLimits limits) const {
  if (limits.length_m == 0.0) {
    limits.length_m = 4.0 * static_cast<double>(grid_.size()) * grid_.cell_m +
                      1000.0 * two_pi * vehicle_.turn_radius_m;
  }
  if (limits.crossings == 0) {
    limits.crossings = static_cast<std::uint64_t>(64.0 * (limits.length_m / grid_.cell_m));
  }
  return limits;
}

/// Asks for the record about four cells ahead: a flight up or down the grid meets a new cache line
/// in every cell, and waiting for it cost more than the geometry.
void ExactFlights::prefetch_ahead(const Position& position) const {
  const Vec2 u = position.state.heading.unit;
  const std::ptrdiff_t place = static_cast<std::ptrdiff_t>(position.place) +
                               static_cast<int>(4.0 * u.x) +
                               static_cast<int>(4.0 * u.y) * static_cast<std::ptrdiff_t>(stride_);
  if (static_cast<std::size_t>(place) < cells_.size()) {
    __builtin_prefetch(&cells_[static_cast<std::size_t>(place)]);
  }
}

/// Moves `position` from the exit into the next cell and returns its kind.
ExactFlights::Kind ExactFlights::enter_next(Position& position, const CellExit& exit) const {
  const double d = grid_.cell_m;
  position.state = exit.state;
  position.slides = false;
  if (exit.on_corner(d) || exit.is_touch()) [[unlikely]]
    return settle(position, false);
  const auto row = static_cast<std::ptrdiff_t>(stride_);
  const std::array<std::ptrdiff_t, 4> steps{1, row, -1, -row};
  position.place += static_cast<std::size_t>(steps[static_cast<std::size_t>(exit.side)]);
  // From the far end of the side to the near end of the next cell, and the other way round.
  const bool vertical = exit.side == Side::right || exit.side == Side::left;
  const double across = exit.side == Side::right || exit.side == Side::top ? 0.0 : d;
  const Vec2 p = exit.state.position_m;
  position.state.position_m = {vertical ? across : p.x, vertical ? p.y : across};
  prefetch_ahead(position);
  return at(position.place).kind;
}

/// Whether the vehicle left by the side it came in by, on an arc: a hop. It mirrors the heading at
/// the border and moves 2 r |normal component| along it. A hop back to the command itself ends in a
/// straight line that only rounding makes longer than 0.
bool ExactFlights::is_hop(const Position& from, const CellExit& exit) const {
  if (!(exit.straight_m < 1e-3 * exit.arc_m) || exit.is_touch() || exit.on_corner(grid_.cell_m))
    return false;
  const bool vertical = exit.side == Side::right || exit.side == Side::left;
  const Vec2 p = from.state.position_m;
  const Vec2 q = exit.state.position_m;
  return vertical ? p.x == q.x : p.y == q.y;
}

/// After a hop in each of the two cells of a border, both repeat, moved along the border, until its
/// end is near: nothing in a cell changes along its border but the distance to the next one. The
/// commands on both sides only ever narrow such a weave, so it can take a million hops to pass one
/// cell. Here they are one leap, which is the same motion. Lengths are 0 when there is none.
/// No longer than `most_m`.
ExactFlights::Leap ExactFlights::leap(Position& position, Side border, double most_m) const {
  const double d = grid_.cell_m;
  const double r = vehicle_.turn_radius_m;
  const bool vertical = border == Side::right || border == Side::left;
  const Vec2 u = position.state.heading.unit;
  const double sine = std::abs(vertical ? u.x : u.y);
  const double pair_m = 4.0 * r * sine;
  if (pair_m > d / 16.0) return {};
  double& along = vertical ? position.state.position_m.y : position.state.position_m.x;
  const bool upwards = (vertical ? u.y : u.x) > 0.0;
  const double to_corner_m = upwards ? d - along : along;
  const double rest_m = std::min(to_corner_m, most_m);
  if (pair_m < 1e-12 * d) {
    // Hops below the resolution of a position would stand still: on to the corner.
    along = rest_m == to_corner_m ? (upwards ? d : 0.0) : along + (upwards ? rest_m : -rest_m);
    return {rest_m, rest_m};
  }
  const double pairs = std::floor(rest_m / pair_m) - 2.0;
  if (pairs < 4.0) return {};
  along += upwards ? pairs * pair_m : -pairs * pair_m;
  return {pairs * pair_m, pairs * 4.0 * r * std::asin(sine)};
}

/// How far a flight continues after reaching: its length is measured from there, and the
/// crossings are as many again as so long a flight is given.
FlightLimits ExactFlights::beyond_goal(FlightLimits limits, const FlightRun& run,
                                       double beyond_m) const {
  if (!(beyond_m < infinity)) return limits;
  return {run.reached_m + beyond_m, run.crossings + with_defaults({beyond_m, 0}).crossings + 64};
}

FlightResult ExactFlights::result_of(const FlightRun& run) const {
  const auto at_length = [&](Outcome outcome, double length_m) {
    return FlightResult{outcome, length_m / vehicle_.speed_mps, length_m};
  };
  if (run.reached_m < infinity) return at_length(Outcome::reach, run.reached_m);
  switch (run.ended_by) {
    case EndedBy::goal:
      return at_length(Outcome::reach, run.flown_m);
    case EndedBy::obstacle:
      return at_length(Outcome::collide, run.flown_m);
    case EndedBy::grid_edge:
      return at_length(Outcome::leave, run.flown_m);
    default:
      return at_length(Outcome::trapped, infinity);
  }
}

Onward ExactFlights::onward_of(const FlightRun& run) const {
  if (run.reached_m == infinity) return {};
  const After after = run.ended_by == EndedBy::obstacle    ? After::collide
                      : run.ended_by == EndedBy::grid_edge ? After::leave
                                                           : After::follow;
  return {after, run.flown_m / vehicle_.speed_mps, run.flown_m};
}

Vec2 ExactFlights::corner_of(std::size_t place) const {
  const Cell cell{static_cast<int>(place % stride_) - 1, static_cast<int>(place / stride_) - 1};
  return grid_.corner(cell);
}

FlightRun ExactFlights::run(const State& start, FlightLimits limits) const {
  NoRecord nothing;
  OneMode one;
  return fly_through<false>(start, with_defaults(limits), infinity, nothing, one);
}

FlightResult ExactFlights::fly(const State& start, FlightLimits limits) const {
  return run(start, limits).result;
}

Flight ExactFlights::recorded(const State& start, FlightLimits limits, bool keeps_pieces) const {
  Recorder recorder(*this, keeps_pieces);
  OneMode one;
  const FlightRun run = fly_through<false>(start, with_defaults(limits), infinity, recorder, one);
  return {start, run.result, recorder.take_pieces(), {}, recorder.turning(), {}};
}

Flight ExactFlights::record(const State& start, FlightLimits limits) const {
  return recorded(start, limits, true);
}

Flight ExactFlights::measure(const State& start, FlightLimits limits) const {
  return recorded(start, limits, false);
}

Flight ExactFlights::followed(const State& start, FlightLimits limits, double beyond_m) const {
  Recorder recorder(*this, true);
  recorder.end_at(limits.length_m > 0.0 ? limits.length_m : infinity);
  OneMode one;
  const FlightRun run = fly_through<true>(start, with_defaults(limits), beyond_m, recorder, one);
  return {start, run.result, recorder.take_pieces(), {}, recorder.turning(), onward_of(run)};
}

Flight ExactFlights::follow(const State& start, double length_m) const {
  require(length_m > 0.0 && std::isfinite(length_m), "a flight is followed for a length > 0");
  return followed(start, {length_m, 0}, infinity);
}

Flight ExactFlights::follow_on(const State& start, const FollowLimit& beyond) const {
  const double beyond_m = std::min(beyond.length_m, beyond.time_s * vehicle_.speed_mps);
  require(beyond_m > 0.0 && std::isfinite(beyond_m), "a flight is followed for a length > 0");
  return followed(start, {}, beyond_m);
}

namespace {

template <typename Result, typename Fly>
std::vector<Result> each(std::span<const State> starts, const Fly& fly) {
  std::vector<Result> results(starts.size());
  for_ranges(starts.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) results[i] = fly(starts[i]);
  });
  return results;
}

}  // namespace

std::vector<FlightResult> ExactFlights::fly_all(std::span<const State> starts,
                                                FlightLimits limits) const {
  return each<FlightResult>(starts, [&](const State& s) { return fly(s, limits); });
}

std::vector<FlightRun> ExactFlights::run_all(std::span<const State> starts,
                                             FlightLimits limits) const {
  return each<FlightRun>(starts, [&](const State& s) { return run(s, limits); });
}

std::vector<Flight> ExactFlights::record_all(std::span<const State> starts,
                                             FlightLimits limits) const {
  return each<Flight>(starts, [&](const State& s) { return record(s, limits); });
}

}  // namespace fairway
