#include "fairway/run/flight_summary.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"

#include "fairway/base/share_text.hpp"
#include "fairway/run/final_legs.hpp"
#include "fairway/run/following_summary.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/simulate/flight_statistics.hpp"

namespace fairway {
namespace {

using nlohmann::json;

}  // namespace

std::string flight_words(const ScenarioFlights& flown) {
  std::string words;
  if (!flown.random_results().empty()) {
    words += fmt::format("Of {} from safe starts with a command, {}. ",
                         plural(flown.random_results().size(), "random flight"),
                         outcome_words(count_outcomes(flown.random_results())));
  }
  if (flown.given > 0) {
    const OutcomeCounts counts = count_outcomes(flown.given_results());
    words += fmt::format("Of {} in the scenario, {}. ", plural(flown.given, "start"),
                         grouped(counts.of(Outcome::reach)) +
                             (counts.of(Outcome::reach) == 1 ? " reaches" : " reach"));
  }
  if (const std::string legs = final_legs_words(flown.final_legs); !legs.empty()) {
    words += legs + " ";
  }
  const std::string onward =
      following_words(following_summary(flown, flown.random_results(), flown.random_measures()));
  return onward.empty() ? words : words + onward + " ";
}

namespace {

void add_measures(json& counts, const ManyFlights& flown, std::span<const FlightResult> results,
                  std::span<const FlightMeasures> measures) {
  counts["turning"] = turning_json(turning_summary(results, measures));
  counts["following"] = following_json(following_summary(flown, results, measures));
}

json measures_json(const FlightMeasures& measures, bool followed) {
  const Turning& turning = measures.turning;
  json one = {{"flown_m", turning.length_m},
              {"reversals", turning.reversals},
              {"turned_rad", turning.turned_rad}};
  if (!followed) return one;
  const PathFollowing& following = measures.following;
  const bool after = measures.onward.after != After::none;
  const bool joined = std::isfinite(following.joined_s);
  const auto when = [](bool known, auto value) { return known ? json(value) : json(); };
  one["after"] = when(after, name_of(measures.onward.after));
  one["after_s"] = when(after, measures.onward.time_s);
  one["joined_s"] = when(joined, following.joined_s);
  one["laps"] = when(joined, following.laps);
  one["on_path_share"] = when(joined, following.on_path_share);
  one["distance_mean_m"] = when(joined, following.distance_mean_m);
  one["distance_worst_m"] = when(joined, following.distance_worst_m);
  one["heading_difference_worst_rad"] = when(joined, following.heading_worst_rad);
  return one;
}

}  // namespace

void add_flights(json& summary, const ScenarioFlights& flown, std::uint64_t seed) {
  summary["random_flights"] = outcome_json(count_outcomes(flown.random_results()));
  summary["random_flights"]["seed"] = seed;
  add_measures(summary["random_flights"], flown, flown.random_results(), flown.random_measures());
  summary["given_flights"] = outcome_json(count_outcomes(flown.given_results()));
  summary["recorded_flights"] = flown.recorded.size();
  summary["final_legs"] = final_legs_json(flown.final_legs);
}

namespace {

/// What came after flight `i` reached, when it was followed and did not just go on.
std::string onward_words(const ManyFlights& flown, std::size_t i) {
  if (flown.measures.empty()) return "";
  const Onward& onward = flown.measures[i].onward;
  if (onward.after != After::collide && onward.after != After::leave) return "";
  return fmt::format(", then {} after {:.2f} s", name_of(onward.after), onward.time_s);
}

}  // namespace

std::string flight_words(std::span<const State> starts, const ManyFlights& flown,
                         const std::string& drawn, const EarthFrame* earth) {
  std::string text;
  constexpr std::size_t most_listed = 20;
  for (std::size_t i = 0; i < starts.size() && starts.size() <= most_listed; ++i) {
    const State& s = starts[i];
    const FlightResult& r = flown.results[i];
    text += fmt::format("({}, {}, {:g} rad){}: {}", coordinate_text(s.position_m.x),
                        coordinate_text(s.position_m.y), s.heading.rad(),
                        earth == nullptr ? "" : " = " + earth_text(earth->degrees_of(s)),
                        name_of(r.outcome));
    if (std::isfinite(r.time_s))
      text += fmt::format(" after {:.2f} s, {:.1f} m", r.time_s, r.length_m);
    text += onward_words(flown, i);
    text += "\n";
  }
  text += fmt::format("Of {}{}, {}.", plural(starts.size(), "flight"), drawn,
                      outcome_words(count_outcomes(flown.results)));
  if (const std::string legs = final_legs_words(flown.final_legs); !legs.empty()) {
    text += "\n" + legs;
  }
  const std::string onward =
      following_words(following_summary(flown, flown.results, flown.measures));
  return onward.empty() ? text : text + "\n" + onward;
}

void add_degrees(json& object, const State& state, const EarthFrame& earth) {
  const EarthState degrees = earth.degrees_of(state);
  const auto rounded = [](double deg, double steps) { return std::round(deg * steps) / steps; };
  object["lat_deg"] = rounded(degrees.latitude_deg, 1e9);
  object["lon_deg"] = rounded(degrees.longitude_deg, 1e9);
  object["course_deg"] = rounded(degrees.course_deg, 1e6);
}

json flight_json(std::span<const State> starts, const ManyFlights& flown, const EarthFrame* earth) {
  json flights = json::array();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const FlightResult& r = flown.results[i];
    const bool ends = std::isfinite(r.time_s);
    flights.push_back({{"x_m", starts[i].position_m.x},
                       {"y_m", starts[i].position_m.y},
                       {"heading_rad", starts[i].heading.rad()},
                       {"outcome", name_of(r.outcome)},
                       {"time_s", ends ? json(r.time_s) : json()},
                       {"length_m", ends ? json(r.length_m) : json()}});
    if (!flown.measures.empty()) {
      flights.back().update(measures_json(flown.measures[i], flown.followed.has_value()));
    }
    if (earth != nullptr) add_degrees(flights.back(), starts[i], *earth);
  }
  json all = outcome_json(count_outcomes(flown.results));
  all["final_legs"] = final_legs_json(flown.final_legs);
  if (!flown.measures.empty()) add_measures(all, flown, flown.results, flown.measures);
  all["flights"] = std::move(flights);
  return all;
}

}  // namespace fairway
