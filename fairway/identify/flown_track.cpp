#include "fairway/identify/flown_track.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

void find_runs(const FlightLog& log, FlownTrack& track) {
  for (std::size_t i = 0; i < log.samples.size(); ++i) {
    const Heading command = log.samples[i].command;
    if (track.runs.empty() || !(track.runs.back().command == command)) {
      if (!track.runs.empty()) track.runs.back().last = i;
      track.runs.push_back({command, i});
    }
    track.run_of.push_back(track.runs.size() - 1);
  }
  track.runs.back().last = log.samples.size() - 1;
}

/// Speed and course of the chord over the window about each sample.
void smooth(FlownTrack& track, double smooth_m) {
  const std::size_t n = track.size();
  std::size_t first = 0;
  std::size_t last = 0;
  Heading course;
  for (std::size_t i = 0; i < n; ++i) {
    while (track.way_m[i] - track.way_m[first] > smooth_m) ++first;
    while (last + 1 < n && track.way_m[last + 1] - track.way_m[i] <= smooth_m) ++last;
    // The window is as long ahead as behind, and at least one sample each way where there is one.
    const std::size_t half = std::max<std::size_t>(1, std::min(i - first, last > i ? last - i : 0));
    const std::size_t a = i >= half ? i - half : 0;
    const std::size_t b = std::min(n - 1, i + half);
    const Vec2 chord = track.place_m[b] - track.place_m[a];
    if (norm2(chord) > 0.0) course = Heading::of(chord);
    track.course.push_back(course);
    track.speed_mps.push_back(norm(chord) / (track.time_s[b] - track.time_s[a]));
  }
}

}  // namespace

FlownTrack flown_track(const FlightLog& log, double smooth_m) {
  require(log.samples.size() >= 2, "a log has at least two samples");
  FlownTrack track;
  for (const LogSample& sample : log.samples) {
    const double step_m = track.place_m.empty() ? 0.0 : norm(sample.place_m - track.place_m.back());
    track.way_m.push_back(track.way_m.empty() ? 0.0 : track.way_m.back() + step_m);
    track.time_s.push_back(sample.time_s);
    track.place_m.push_back(sample.place_m);
  }
  find_runs(log, track);
  smooth(track, smooth_m);
  return track;
}

double turn_radius_flown_m(const FlownTrack& track) {
  constexpr double least_turn_rad = 1.0;
  constexpr double hardest = 0.95;
  constexpr double share_of_hardest = 0.7;
  std::vector<double> rates;  // curvature, per metre
  double turned_rad = 0.0;
  for (std::size_t i = 1; i + 1 < track.size(); ++i) {
    const double way_m = track.way_m[i + 1] - track.way_m[i - 1];
    const double turn_rad = std::abs(track.course[i - 1].turn_to(track.course[i + 1]));
    if (way_m > 0.0) rates.push_back(turn_rad / way_m);
    turned_rad += 0.5 * turn_rad;
  }
  constexpr double never = std::numeric_limits<double>::infinity();
  if (turned_rad < least_turn_rad || rates.empty()) return never;
  std::sort(rates.begin(), rates.end());
  const double top =
      rates[static_cast<std::size_t>(hardest * static_cast<double>(rates.size() - 1))];
  const auto from = std::lower_bound(rates.begin(), rates.end(), share_of_hardest * top);
  const double median = *(from + (rates.end() - from) / 2);
  return median > 0.0 ? 1.0 / median : never;
}

SizeRange speeds_flown_mps(const FlownTrack& track) {
  const auto [least, most] = std::minmax_element(track.speed_mps.begin(), track.speed_mps.end());
  return {*least, *most};
}

}  // namespace fairway
