// A flight log as the search for a motion uses it: its way cut into steps, its course taken from
// its places, and its commands as runs.
//
// Places are rounded and courses noisy, so speed and course are those of the chord over a window of
// an eighth of a turn's time each side.
#pragma once

#include <cstddef>
#include <vector>

#include "fairway/identify/flight_log.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway {

/// A command and how long it was in force.
struct CommandRun {
  Heading command;
  std::size_t last = 0;  ///< sample at which it was superseded (closed: it may still be in force)
};

struct FlownTrack {
  std::vector<double> time_s;
  std::vector<Vec2> place_m;
  std::vector<Heading> course;    ///< of the smoothed motion
  std::vector<double> speed_mps;  ///< smoothed
  std::vector<double> way_m;      ///< flown since the first sample
  std::vector<CommandRun> runs;
  std::vector<std::size_t> run_of;  ///< the run in force at each sample

  std::size_t size() const { return time_s.size(); }
};

/// Turning radius of the log where it turns hardest, metres: the median over the samples whose turn
/// rate is at least 0.7 of its 95th percentile. Infinite where it does not turn by a radian in all.
[[nodiscard]] double turn_radius_flown_m(const FlownTrack& track);

/// `smooth_m`: the way over which speed and course are smoothed, to each side; about an eighth of
/// the turning radius. At least two samples.
[[nodiscard]] FlownTrack flown_track(const FlightLog& log, double smooth_m);

/// The least and the greatest smoothed speed.
[[nodiscard]] SizeRange speeds_flown_mps(const FlownTrack& track);

}  // namespace fairway
