#include "fairway/exchange/track.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

double distance_to_chord_m(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double length2 = norm2(along);
  const double share = length2 > 0.0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  return norm(p - (a + share * along));
}

/// A piece's points, its start and all but its end, at most `step_m` apart.
void add_points(const FlightSegment& piece, double speed_mps, double step_m,
                std::vector<FlightPoint>& track) {
  const double steps = std::max(1.0, std::ceil(piece.length_m / step_m));
  for (double i = 0.0; i < steps; i += 1.0) {
    const double along_m = piece.length_m * i / steps;
    track.push_back(
        {piece.time_s + along_m / speed_mps, state_at(piece, along_m), piece.curvature_per_m});
  }
}

/// The flight's pieces, then those of its last leg.
std::vector<FlightSegment> pieces_of(const Flight& flight) {
  std::vector<FlightSegment> pieces = flight.segments;
  const std::vector<FlightSegment>& leg = flight.final_leg.segments;
  pieces.insert(pieces.end(), leg.begin(), leg.end());
  return pieces;
}

void add_end(const std::vector<FlightSegment>& pieces, const State& start, double speed_mps,
             std::vector<FlightPoint>& track) {
  if (pieces.empty()) {
    track.push_back({0.0, start, 0.0});
    return;
  }
  const FlightSegment& last = pieces.back();
  track.push_back({last.time_s + last.length_m / speed_mps, state_at(last, last.length_m),
                   last.curvature_per_m});
}

}  // namespace

std::vector<FlightPoint> track_of(const Flight& flight, double speed_mps, double step_m) {
  require(speed_mps > 0.0 && step_m > 0.0, "speed and step are positive");
  std::vector<FlightPoint> track;
  const std::vector<FlightSegment> pieces = pieces_of(flight);
  for (const FlightSegment& piece : pieces) add_points(piece, speed_mps, step_m, track);
  add_end(pieces, flight.start, speed_mps, track);
  return track;
}

std::vector<FlightPoint> thinned_track(const Flight& flight, double speed_mps, double tolerance_m) {
  require(speed_mps > 0.0 && tolerance_m > 0.0, "speed and tolerance are positive");
  // Chords of an arc of radius R keep within step^2 / (8 R) of it: a quarter of the tolerance.
  std::vector<FlightPoint> track;
  const std::vector<FlightSegment> pieces = pieces_of(flight);
  for (const FlightSegment& piece : pieces) {
    const double bend_per_m = std::abs(piece.curvature_per_m);
    const double step_m =
        bend_per_m > 0.0 ? std::sqrt(2.0 * tolerance_m / bend_per_m) : piece.length_m + 1.0;
    // Not more than a radian of an arc to a chord, however wide the tolerance.
    const double least_m = bend_per_m > 0.0 ? std::min(step_m, 1.0 / bend_per_m) : step_m;
    add_points(piece, speed_mps, least_m, track);
  }
  add_end(pieces, flight.start, speed_mps, track);

  const double reach_m = 0.75 * tolerance_m;
  std::vector<bool> kept(track.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, track.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = first;
    double most_m = reach_m;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double off_m = distance_to_chord_m(
          track[i].state.position_m, track[first].state.position_m, track[last].state.position_m);
      if (off_m <= most_m) continue;
      most_m = off_m;
      farthest = i;
    }
    if (farthest == first) continue;
    kept[farthest] = true;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
  std::vector<FlightPoint> thinned;
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (kept[i]) thinned.push_back(track[i]);
  }
  return thinned;
}

}  // namespace fairway
