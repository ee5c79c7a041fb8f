#include "fairway/run/time_left.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

namespace fairway {
namespace {

constexpr std::size_t fitted = 5;       // levels that the line goes through
constexpr double least_slope = 0.15;    // share ~ time^-slope; flatter lines lead nowhere
constexpr double farthest_factor = 10;  // of the time so far, that a line is believed for

}  // namespace

void UndecidedTrend::add(double at_s, double undecided) {
  if (!(at_s > 0.0 && undecided > 0.0)) return;
  points_.push_back({std::log(at_s), std::log(undecided)});
}

std::optional<double> UndecidedTrend::end_s() const {
  if (points_.size() < 3 || !(undecided_max_ > 0.0)) return std::nullopt;
  const std::size_t n = std::min(points_.size(), fitted);
  const auto begin = points_.end() - static_cast<std::ptrdiff_t>(n);
  double mean_at = 0.0;
  double mean_share = 0.0;
  for (auto p = begin; p != points_.end(); ++p) {
    mean_at += p->log_at / static_cast<double>(n);
    mean_share += p->log_share / static_cast<double>(n);
  }
  double both = 0.0;
  double at = 0.0;
  for (auto p = begin; p != points_.end(); ++p) {
    both += (p->log_at - mean_at) * (p->log_share - mean_share);
    at += (p->log_at - mean_at) * (p->log_at - mean_at);
  }
  if (!(at > 0.0) || !(both < -least_slope * at)) return std::nullopt;
  // From the last level on, along the line: what it lies off the line is not made up for. The work
  // ends with a level, on average half a level beyond the goal.
  const Point& last = points_.back();
  const double a_level = (last.log_share - begin->log_share) / static_cast<double>(n - 1);
  const double to_go = std::log(undecided_max_) - last.log_share + 0.5 * a_level;
  const double ahead = std::max(0.0, to_go * at / both);
  if (ahead > std::log(farthest_factor)) return std::nullopt;
  return std::exp(last.log_at + ahead);
}

std::string duration_text(double seconds) {
  const double whole = std::ceil(std::max(seconds, 0.0));
  if (whole < 60.0) return fmt::format("{:.0f} s", whole);
  return fmt::format("{:.0f} min {:02.0f} s", std::floor(whole / 60.0), std::fmod(whole, 60.0));
}

std::string time_left_words(const TimeLeft& left, double since_s) {
  const double estimate_s = left.estimate_s - since_s;
  const double limit_s = left.limit_s - since_s;
  const bool limited = left.limit_s >= 0.0;
  if (left.estimate_s >= 0.0 && !(limited && limit_s <= estimate_s)) {
    if (estimate_s > 1.0) return ", about " + duration_text(estimate_s) + " left";
    if (!limited) return estimate_s > -5.0 ? ", almost done" : "";  // an estimate that was wrong
  }
  if (!limited) return {};
  return limit_s > 0.0 ? ", time limit in " + duration_text(limit_s) : ", time limit reached";
}

double next_line_s(double so_far_s) {
  constexpr double first_s = 10.0;
  constexpr double longest_s = 600.0;
  double next = first_s;
  while (next <= so_far_s) next += std::min(next, longest_s);
  return next;
}

}  // namespace fairway
