#include "check/lap_sums.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace fairway_check {
namespace {

constexpr double time_margin = 1.0 + 1e-9;

Point scaled_unit(double rad, double by) { return {by * std::cos(rad), by * std::sin(rad)}; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

}  // namespace

LapSums::LapSums(const ContractCertificate& c)
    : late_s_(c.follow->stages(), -HUGE_VAL),
      way_m_(c.follow->stages(), HUGE_VAL),
      begin_s_(c.follow->stages(), HUGE_VAL),
      end_s_(c.follow->stages(), -HUGE_VAL),
      off_rad_(c.follow->off_rad.begin(), c.follow->off_rad.end()) {
  const FollowClaims& f = *c.follow;
  for (std::size_t k = 0; k < f.stages(); ++k) {
    along_.push_back(scaled_unit(f.heading_rad[k], 1.0));
    slowness_.push_back(
        f.bends(k) ? Point{0.0, 0.0}
                   : scaled_unit(f.heading_rad[k],
                                 1.0 / (c.contract.least_speed * std::cos(double(f.off_rad[k])))));
  }
}

/// From x to x' in a stage with slowness w takes at most w . (x' - x): over a lap the sum of
/// x . (w - w'), where one stage ends and the next begins, and what laps do not begin alike.
void LapSums::pass(std::size_t k, std::size_t stages, Point at) {
  const std::size_t count = late_s_.size();
  end_s_[k] = std::max(end_s_[k], dot(at, slowness_[k]));
  for (std::size_t i = 0; i < stages; ++i, k = (k + 1) % count) {
    const std::size_t next = (k + 1) % count;
    begin_s_[next] = std::min(begin_s_[next], dot(at, slowness_[next]));
    late_s_[k] = std::max(late_s_[k], dot(at, slowness_[k] - slowness_[next]));
    way_m_[k] = std::min(way_m_[k], dot(at, along_[k] - along_[next]));
    if (next != 0) continue;
    start_least_s_ = std::min(start_least_s_, dot(at, slowness_[0]));
    start_most_s_ = std::max(start_most_s_, dot(at, slowness_[0]));
    start_least_m_ = std::min(start_least_m_, dot(at, along_[0]));
    start_most_m_ = std::max(start_most_m_, dot(at, along_[0]));
  }
}

void LapSums::slow_down(std::size_t k, double off_rad) {
  off_rad_[k] = std::max(off_rad_[k], off_rad);
}

/// By how much longer stage k takes than with the angle claimed: along its whole extent at most.
double LapSums::slower_s(std::size_t k, double claimed_rad) const {
  if (!(off_rad_[k] > claimed_rad)) return 0.0;
  const double extent_s = std::max(0.0, end_s_[k] - begin_s_[k]);
  return extent_s * (std::cos(claimed_rad) / std::cos(off_rad_[k]) - 1.0);
}

void LapSums::add(const LapSums& other) {
  for (std::size_t k = 0; k < late_s_.size(); ++k) {
    late_s_[k] = std::max(late_s_[k], other.late_s_[k]);
    way_m_[k] = std::min(way_m_[k], other.way_m_[k]);
    begin_s_[k] = std::min(begin_s_[k], other.begin_s_[k]);
    end_s_[k] = std::max(end_s_[k], other.end_s_[k]);
    if (other.off_rad_[k] > off_rad_[k]) off_rad_[k] = other.off_rad_[k];
  }
  start_least_s_ = std::min(start_least_s_, other.start_least_s_);
  start_most_s_ = std::max(start_most_s_, other.start_most_s_);
  start_least_m_ = std::min(start_least_m_, other.start_least_m_);
  start_most_m_ = std::max(start_most_m_, other.start_most_m_);
}

std::string LapSums::defect(const ContractCertificate& c) const {
  const FollowClaims& f = *c.follow;
  if (f.holds) return f.lap_least_s == 0.0 && f.lap_most_s == 0.0 ? "" : "lap_time_s: expected 0";
  if (!f.closed) {
    const bool follows = f.lap_least_s == 0.0 && f.lap_most_s >= static_cast<double>(f.time_s[0]);
    return follows ? "" : "lap_time_s: does not follow from the time to the end";
  }
  double most_s = start_most_s_ - start_least_s_;
  double least_m = start_least_m_ - start_most_m_;
  for (std::size_t k = 0; k < late_s_.size(); ++k) {
    most_s += late_s_[k] + static_cast<double>(f.time_s[k]) +
              slower_s(k, static_cast<double>(f.off_rad[k]));
    least_m += way_m_[k];
  }
  // Every stage is left by somebody, or its sums are infinite.
  if (!std::isfinite(most_s) || !std::isfinite(least_m)) return "stages: one is never left";
  const double least_s = least_m / c.contract.most_speed;
  if (f.lap_most_s < most_s * time_margin || f.lap_least_s * time_margin > std::max(0.0, least_s)) {
    return fmt::format("lap_time_s: is {:.9g} to {:.9g} s, claimed as {:.9g} to {:.9g} s", least_s,
                       most_s, f.lap_least_s, f.lap_most_s);
  }
  return "";
}

}  // namespace fairway_check
