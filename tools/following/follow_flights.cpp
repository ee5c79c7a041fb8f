#include "tools/following/follow_flights.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/heading.hpp"

namespace fairway::following {
namespace {

constexpr double steps_per_radius = 10.0;

/// A flight as it goes along its path.
struct Track {
  bool inside = false;
  double inside_since_m = 0.0;
  double progress_m = 0.0;
  double last_station_m = -1.0;
  double tube_m = 0.0;
};

}  // namespace

FollowFlights::FollowFlights(const Plan& plan, double tube_radii)
    : flights_(plan),
      locator_(std::get<PathMission>(plan.record.mission.value())),
      turn_radius_m_(plan.vehicle.turn_radius_m),
      tube_m_(tube_radii * turn_radius_m_),
      step_m_(turn_radius_m_ / steps_per_radius) {
  find_gentle();
}

/// Directions over half a radius, so that vertices of a curve drawn as a polyline are no bends.
std::vector<bool> FollowFlights::bends() const {
  const auto n = static_cast<std::size_t>(std::ceil(locator_.length_m() / step_m_)) + 1;
  const double half_m = 0.5 * turn_radius_m_;
  std::vector<bool> found(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    const double station_m = static_cast<double>(i) * step_m_;
    const Vec2 here = locator_.place(station_m);
    const Vec2 before = here - locator_.place(station_m - half_m);
    const Vec2 after = locator_.place(station_m + half_m) - here;
    if (norm(before) == 0.0 || norm(after) == 0.0) continue;
    const double turn_rad = std::abs(Heading::of(before).turn_to(Heading::of(after)));
    found[i] = turn_rad > half_m / (2.0 * turn_radius_m_);
  }
  return found;
}

void FollowFlights::find_gentle() {
  const std::vector<bool> sharp = bends();
  const auto n = static_cast<long>(sharp.size());
  gentle_.assign(sharp.size(), true);
  for (long i = 0; i < n; ++i) {
    if (!sharp[static_cast<std::size_t>(i)]) continue;
    for (long k = -static_cast<long>(steps_per_radius);
         k <= static_cast<long>(3 * steps_per_radius); ++k) {
      const long j = locator_.path().closed ? (i + k + n) % n : std::clamp(i + k, 0L, n - 1);
      gentle_[static_cast<std::size_t>(j)] = false;
    }
  }
}

bool FollowFlights::gentle_at(double station_m) const {
  const auto i = static_cast<std::size_t>(station_m / step_m_);
  return gentle_[std::min(i, gentle_.size() - 1)];
}

bool FollowFlights::is_gentle(double from_share, double to_share) const {
  const double to_m = to_share * length_m();
  for (double at_m = from_share * length_m(); at_m < to_m; at_m += 0.5 * step_m_) {
    if (!gentle_at(at_m)) return false;
  }
  return gentle_at(to_m);
}

FollowedFlight FollowFlights::fly(const State& start, double laps) const {
  const double length_m = locator_.length_m();
  const bool closed = locator_.path().closed;
  constexpr double joining_radii = 40.0;
  const Flight flight = flights_.follow(start, laps * length_m + joining_radii * turn_radius_m_);
  double total_m = 0.0;
  for (const FlightSegment& piece : flight.segments) total_m += piece.length_m;
  const double last_lap_from_m = total_m - (closed ? 1.0 : 0.5) * length_m;
  FollowedFlight out;
  out.begins_forward = dot(start.heading.unit(), locator_.frame(start.position_m).tangent) >= 0.0;
  Track track;
  double flown_m = 0.0;
  bool ended = false;
  const auto look = [&](const State& state, double at_m) {
    const PathFrame frame = locator_.frame(state.position_m);
    if (!closed && track.inside && frame.station_m >= length_m) return false;
    if (track.last_station_m >= 0.0) {
      const double moved_m = frame.station_m - track.last_station_m;
      track.progress_m += closed ? std::remainder(moved_m, length_m) : moved_m;
    }
    track.last_station_m = frame.station_m;
    const bool near = std::abs(frame.offset_m) <= tube_m_;
    const bool gentle = gentle_at(frame.station_m);
    if (!near && gentle) {
      track.inside = false;
    } else if (!track.inside && near && dot(state.heading.unit(), frame.tangent) > 0.0) {
      track.inside = true;
      track.inside_since_m = at_m;
    }
    if (gentle && at_m > last_lap_from_m) {
      track.tube_m = std::max(track.tube_m, std::abs(frame.offset_m));
    }
    return true;
  };
  for (const FlightSegment& piece : flight.segments) {
    const int parts = std::max(1, static_cast<int>(std::ceil(piece.length_m / step_m_)));
    for (int k = 0; k < parts && !ended; ++k) {
      const double along_m = piece.length_m * k / parts;
      ended = !look(state_at(piece, along_m), flown_m + along_m);
    }
    flown_m += piece.length_m;
  }
  out.join_m = track.inside_since_m;
  out.tube_m = track.tube_m;
  const double after_join_m = flown_m - track.inside_since_m;
  const auto either = [&](Outcome outcome, After after) {
    return flight.result.outcome == outcome || flight.onward.after == after;
  };
  if (ended) {
    out.fate = Fate::follow;
  } else if (either(Outcome::collide, After::collide)) {
    out.fate = Fate::collide;
  } else if (either(Outcome::leave, After::leave)) {
    out.fate = Fate::leave;
  } else if (!closed || track.progress_m < 0.5 * flown_m) {
    out.fate = Fate::circle;
  } else {
    out.fate = track.inside && after_join_m > (laps - 1.0) * length_m ? Fate::follow : Fate::loose;
  }
  return out;
}

}  // namespace fairway::following
