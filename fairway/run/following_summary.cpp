#include "fairway/run/following_summary.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

namespace fairway {
namespace {

using nlohmann::json;

std::string plural(double n, const char* noun) {
  return fmt::format("{:g} {}{}", n, noun, n == 1.0 ? "" : "s");
}

json share_or_null(std::size_t part, std::size_t whole) {
  return whole == 0 ? json() : json(static_cast<double>(part) / static_cast<double>(whole));
}

std::string words_of(const FollowFor& followed, bool holds) {
  if (followed.time_s > 0.0) return plural(followed.time_s, "second");
  return plural(followed.laps, "lap") + (holds ? " of the circle" : "");
}

}  // namespace

TurningSummary turning_summary(std::span<const FlightResult> results,
                               std::span<const FlightMeasures> measures) {
  std::vector<double> reversals;
  std::vector<double> reversals_per_100m;
  std::vector<double> turned_rad;
  std::vector<double> turned_rad_per_100m;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    const Turning& turning = measures[i].turning;
    const Outcome outcome = results[i].outcome;
    const bool endless = outcome == Outcome::trapped || outcome == Outcome::hold;
    if (endless || !(turning.length_m > 0.0)) continue;
    const auto count = static_cast<double>(turning.reversals);
    reversals.push_back(count);
    reversals_per_100m.push_back(100.0 * count / turning.length_m);
    turned_rad.push_back(turning.turned_rad);
    turned_rad_per_100m.push_back(100.0 * turning.turned_rad / turning.length_m);
  }
  return {spread_of(std::move(reversals)), spread_of(std::move(reversals_per_100m)),
          spread_of(std::move(turned_rad)), spread_of(std::move(turned_rad_per_100m))};
}

std::optional<FollowingSummary> following_summary(const ManyFlights& flown,
                                                  std::span<const FlightResult> results,
                                                  std::span<const FlightMeasures> measures) {
  if (!flown.followed || flown.measures.empty()) return {};
  FollowingSummary found;
  found.how = flown.followed->how;
  found.holds = flown.followed->holds;
  found.delta_position_m = flown.followed->delta_position_m;
  found.delta_heading_rad = flown.followed->delta_heading_rad;
  std::vector<double> join_s;
  double measured_s = 0.0;
  double distance_sum = 0.0;
  double heading_sum = 0.0;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    if (results[i].outcome != Outcome::reach) continue;
    ++found.reach;
    found.collide_after += measures[i].onward.after == After::collide ? 1 : 0;
    found.leave_after += measures[i].onward.after == After::leave ? 1 : 0;
    const PathFollowing& one = measures[i].following;
    if (!std::isfinite(one.joined_s)) continue;
    ++found.joined;
    join_s.push_back(one.joined_s);
    measured_s += one.measured_s;
    found.on_path_share += one.measured_s * one.on_path_share;
    distance_sum += one.measured_s * one.distance_mean_m;
    heading_sum += one.measured_s * one.heading_mean_rad;
  }
  found.time_to_join_s = spread_of(std::move(join_s));
  found.distance_m = flown.followed->spreads.distance_m.spread();
  found.heading_difference_rad = flown.followed->spreads.heading_rad.spread();
  if (measured_s > 0.0) {  // in the order of the starts: no mean depends on the threads
    found.on_path_share /= measured_s;
    found.distance_m.mean = distance_sum / measured_s;
    found.heading_difference_rad.mean = heading_sum / measured_s;
  }
  return found;
}

json spread_json(const Spread& spread) {
  if (spread.count == 0) return {};
  return {{"mean", spread.mean}, {"p95", spread.p95}, {"worst", spread.worst}};
}

json turning_json(const TurningSummary& turning) {
  return {{"count", turning.reversals.count},
          {"reversals", spread_json(turning.reversals)},
          {"reversals_per_100m", spread_json(turning.reversals_per_100m)},
          {"turned_rad", spread_json(turning.turned_rad)},
          {"turned_rad_per_100m", spread_json(turning.turned_rad_per_100m)}};
}

json following_json(const std::optional<FollowingSummary>& following) {
  if (!following) return {};
  const FollowingSummary& f = *following;
  const bool by_time = f.how.time_s > 0.0;
  const std::size_t follow = f.reach - f.collide_after - f.leave_after;
  return {{"laps", by_time ? json() : json(f.how.laps)},
          {"time_s", by_time ? json(f.how.time_s) : json()},
          {"delta_position_m", f.delta_position_m},
          {"delta_heading_rad", f.delta_heading_rad},
          {"reach", f.reach},
          {"after",
           {{f.holds ? "hold" : "follow", follow},
            {"collide", f.collide_after},
            {"leave", f.leave_after}}},
          {"collide_share_of_reach", share_or_null(f.collide_after, f.reach)},
          {"joined", f.joined},
          {"time_to_join_s", spread_json(f.time_to_join_s)},
          {"distance_m", spread_json(f.distance_m)},
          {"heading_difference_rad", spread_json(f.heading_difference_rad)},
          {"on_path_share", f.joined == 0 ? json() : json(f.on_path_share)}};
}

std::string following_words(const std::optional<FollowingSummary>& following) {
  if (!following || following->reach == 0) return "";
  const FollowingSummary& f = *following;
  const char* line = f.holds ? "circle" : "path";
  std::string words = fmt::format(
      "Followed for {} after they reach the {}, {} of these {} collide and {} leave the map.",
      words_of(f.how, f.holds), f.holds ? "goal" : "path", f.collide_after, f.reach, f.leave_after);
  if (f.joined == 0) {
    return words + fmt::format(" None ever gets onto the {} (within {:g} m and {:g} rad).", line,
                               f.delta_position_m, f.delta_heading_rad);
  }
  return words +
         fmt::format(
             " {} join the {} (within {:g} m and {:g} rad), after {:.0f} s on average and {:.0f} "
             "s at worst, and stay on it for {:.0f} % of the time afterwards: {:.1f} m from it on "
             "average, at most {:.1f} m for 95 % of the time, {:.1f} m at worst.",
             f.joined, line, f.delta_position_m, f.delta_heading_rad, f.time_to_join_s.mean,
             f.time_to_join_s.worst, std::floor(100.0 * f.on_path_share), f.distance_m.mean,
             f.distance_m.p95, f.distance_m.worst);
}

}  // namespace fairway
