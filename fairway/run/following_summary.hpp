// Measures of flights in addition to their outcomes: turning, and how closely those along a path
// keep to it.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "fairway/run/fly_many.hpp"
#include "fairway/simulate/flight_measures.hpp"
#include "fairway/simulate/value_spread.hpp"

namespace fairway {

/// Of the flights that end: those that circle for ever turn without end.
struct TurningSummary {
  Spread reversals;
  Spread reversals_per_100m;
  Spread turned_rad;
  Spread turned_rad_per_100m;
};
[[nodiscard]] TurningSummary turning_summary(std::span<const FlightResult> results,
                                             std::span<const FlightMeasures> measures);

/// Of the flights of a path mission, or about a goal to hold at, all but `reach` of them left out.
struct FollowingSummary {
  FollowFor how;                  ///< for how long beyond the first goal cell
  bool holds = false;             ///< about a goal, on a circle
  double delta_position_m = 0.0;  ///< of the mission (paper 1, Eq. 5)
  double delta_heading_rad = 0.0;
  std::size_t reach = 0;
  std::size_t collide_after = 0;  ///< of those that reach
  std::size_t leave_after = 0;    ///< of those that reach
  std::size_t joined = 0;  ///< of those that reach: on the path, within both deltas, at a time
  Spread time_to_join_s;   ///< over the flights that joined, since their starts
  Spread distance_m;       ///< over the time of those flights after they joined
  Spread heading_difference_rad;
  double on_path_share = 0.0;  ///< of that time
};
/// None unless the flights were followed and measured. `results` and `measures` are those of the
/// pooled flights.
[[nodiscard]] std::optional<FollowingSummary> following_summary(
    const ManyFlights& flown, std::span<const FlightResult> results,
    std::span<const FlightMeasures> measures);

/// Members mean, p95, worst; null when there are no values.
[[nodiscard]] nlohmann::json spread_json(const Spread& spread);
[[nodiscard]] nlohmann::json turning_json(const TurningSummary& turning);
/// null for none.
[[nodiscard]] nlohmann::json following_json(const std::optional<FollowingSummary>& following);

/// What comes after reaching, in a sentence or two; empty for none, or when no flight reaches.
[[nodiscard]] std::string following_words(const std::optional<FollowingSummary>& following);

}  // namespace fairway
