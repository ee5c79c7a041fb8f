#include "fairway/run/time_left.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

namespace fairway {
namespace {

constexpr std::size_t shares_seen = 7;    // levels, for what a level leaves undecided
constexpr std::size_t times_seen = 4;     // levels, for how their times grow
constexpr double least_fall = 0.05;       // of log share a level; flatter leads nowhere
constexpr double least_growth = 1.2;      // of a level's time over the one before: what a single
constexpr double most_growth = 1.8;       // level of an odd length must not be taken for
constexpr double farthest_factor = 10.0;  // of the time so far, that this is believed for

}  // namespace

void UndecidedTrend::add(double at_s, double undecided) {
  if (!(at_s > 0.0 && undecided > 0.0)) return;
  if (!levels_.empty() && !(at_s > levels_.back().at_s)) return;
  levels_.push_back({at_s, std::log(undecided)});
}

std::optional<UndecidedTrend::Pace> UndecidedTrend::pace() const {
  if (levels_.size() < 3) return std::nullopt;
  // A straight line through the logarithms of the last levels' times.
  const std::size_t n = std::min(levels_.size() - 1, times_seen);
  double mean = 0.0;
  double rise = 0.0;
  double spread = 0.0;
  const double middle = 0.5 * static_cast<double>(n - 1);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = levels_.size() - n + k;
    const double log_took = std::log(levels_[i].at_s - levels_[i - 1].at_s);
    const double x = static_cast<double>(k) - middle;
    mean += log_took / static_cast<double>(n);
    rise += x * log_took;
    spread += x * x;
  }
  const double slope = std::clamp(rise / spread, std::log(least_growth), std::log(most_growth));
  return Pace{std::exp(mean + slope * middle), std::exp(slope)};
}

std::optional<double> UndecidedTrend::end_s() const {
  const std::optional<Pace> pace = this->pace();
  if (!pace || !(undecided_max_ > 0.0)) return std::nullopt;
  const std::size_t n = std::min(levels_.size(), shares_seen);
  const Level& last = levels_.back();
  const double fall =
      (levels_[levels_.size() - n].log_share - last.log_share) / static_cast<double>(n - 1);
  if (!(fall >= least_fall)) return std::nullopt;
  // The work ends with a level, on average half a level beyond undecided_max.
  const double levels = std::max(0.0, (last.log_share - std::log(undecided_max_)) / fall) + 0.5;
  const double g = pace->growth;
  const double left_s = pace->took_s * g * (std::pow(g, levels) - 1.0) / (g - 1.0);
  if (!(left_s <= (farthest_factor - 1.0) * last.at_s)) return std::nullopt;
  return last.at_s + left_s;
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
