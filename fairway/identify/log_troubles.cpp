#include "fairway/identify/log_troubles.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"

namespace fairway {
namespace {

constexpr std::size_t fewest_samples = 50;
constexpr double longest_gap_steps = 5.0;  // in usual steps of time
constexpr double fastest_jump = 5.0;       // in usual speeds
constexpr double most_slip_rad = 0.6;      // of the course from the motion, half of the time
constexpr double most_step_radii = 0.34;   // samples a third of a radius apart

[[noreturn]] void refuse(const FlightLog& log, const LogSample& at, const std::string& what) {
  throw InputError(fmt::format("{}:{}", log.name, at.line), what);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Usual values: the medians over the log.
struct Usual {
  double step_s = 0.0;
  double speed_mps = 0.0;
};

Usual usual_of(const FlightLog& log) {
  std::vector<double> steps_s;
  std::vector<double> speeds_mps;
  for (std::size_t i = 1; i < log.samples.size(); ++i) {
    const double step_s = log.samples[i].time_s - log.samples[i - 1].time_s;
    steps_s.push_back(step_s);
    speeds_mps.push_back(norm(log.samples[i].place_m - log.samples[i - 1].place_m) / step_s);
  }
  return {median(std::move(steps_s)), median(std::move(speeds_mps))};
}

void require_time_grows(const FlightLog& log) {
  for (std::size_t i = 1; i < log.samples.size(); ++i) {
    const double before_s = log.samples[i - 1].time_s;
    const double now_s = log.samples[i].time_s;
    if (now_s > before_s) continue;
    refuse(log, log.samples[i],
           fmt::format("time goes from {:.6g} s to {:.6g} s: expected times that grow from line to "
                       "line; cut the log there, and give its parts as logs of their own",
                       before_s, now_s));
  }
}

void require_whole(const FlightLog& log, const Usual& usual) {
  for (std::size_t i = 1; i < log.samples.size(); ++i) {
    const LogSample& now = log.samples[i];
    const double step_s = now.time_s - log.samples[i - 1].time_s;
    if (step_s > longest_gap_steps * usual.step_s) {
      refuse(log, now,
             fmt::format("a gap of {:.3g} s after t = {:.6g} s where samples are {:.3g} s apart: "
                         "expected at most {:.3g} s; cut the log there, and give its parts as logs "
                         "of their own",
                         step_s, log.samples[i - 1].time_s, usual.step_s,
                         longest_gap_steps * usual.step_s));
    }
    const double speed_mps = norm(now.place_m - log.samples[i - 1].place_m) / step_s;
    if (speed_mps > fastest_jump * usual.speed_mps) {
      refuse(
          log, now,
          fmt::format("the place jumps by {} m in {:.3g} s at t = {:.6g} s, where the log usually "
                      "moves at {:.3g} m/s: expected places of one flight; cut the log there",
                      length_text(norm(now.place_m - log.samples[i - 1].place_m)), step_s,
                      now.time_s, usual.speed_mps));
    }
  }
}

/// The turn from the logged course to the direction of the motion, by which way it is counted.
void require_course_is_motion(const FlightLog& log) {
  std::vector<double> slips;
  std::vector<double> compass_slips;
  for (std::size_t i = 5; i + 5 < log.samples.size(); ++i) {
    const Vec2 way = log.samples[i + 5].place_m - log.samples[i - 5].place_m;
    if (norm2(way) == 0.0) continue;
    const Heading motion = Heading::of(way);
    const Heading course = log.samples[i].course;
    slips.push_back(std::abs(course.turn_to(motion)));
    compass_slips.push_back(std::abs(Heading::from_rad(0.5 * pi - course.rad()).turn_to(motion)));
  }
  if (slips.empty()) {
    throw InputError(log.name, "the place never changes: expected the log of a moving vehicle");
  }
  const double slip = median(std::move(slips));
  if (slip <= most_slip_rad) return;
  const bool other_way = median(std::move(compass_slips)) <= most_slip_rad;
  throw InputError(
      log.name,
      fmt::format("its courses are not the direction of its motion (half of the time they are more "
                  "than {:.0f} degrees off): expected courses over ground{}",
                  slip * 180.0 / pi,
                  other_way ? "; they fit if angles are counted the other way: see --angles"
                            : ", counted as --angles says"));
}

}  // namespace

void require_sound(const FlightLog& log) {
  if (log.samples.size() < fewest_samples) {
    throw InputError(log.name, fmt::format("{} samples: expected at least {}, a flight of several "
                                           "turns",
                                           log.samples.size(), fewest_samples));
  }
  require_time_grows(log);
  require_whole(log, usual_of(log));
  require_course_is_motion(log);
}

void require_turns(const FlightLog& log, double turn_radius_m) {
  if (!std::isfinite(turn_radius_m)) {
    throw InputError(log.name,
                     "the vehicle never turns by a radian: expected turns at full bank to both "
                     "sides, for a log without turns says nothing about the turning radius");
  }
  const auto changes = std::adjacent_find(
      log.samples.begin(), log.samples.end(),
      [](const LogSample& a, const LogSample& b) { return !(a.command == b.command); });
  if (changes == log.samples.end()) {
    throw InputError(log.name,
                     "the command never changes: expected a column with the course that was "
                     "commanded at each time");
  }
}

void require_fine(const FlightLog& log, double turn_radius_m) {
  const Usual usual = usual_of(log);
  const double step_m = usual.step_s * usual.speed_mps;
  if (step_m <= most_step_radii * turn_radius_m) return;
  refuse(log, log.samples[1],
         fmt::format("samples are {} m apart, more than a third of the turning radius of {} m: "
                     "expected a sample every {:.2g} s or faster",
                     length_text(step_m), length_text(turn_radius_m),
                     rounded_down(most_step_radii * turn_radius_m / usual.speed_mps, 2)));
}

}  // namespace fairway
