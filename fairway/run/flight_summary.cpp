#include "fairway/run/flight_summary.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"

#include "fairway/run/final_legs.hpp"
#include "fairway/run/share_text.hpp"
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
  return words;
}

void add_flights(json& summary, const ScenarioFlights& flown, std::uint64_t seed) {
  summary["random_flights"] = outcome_json(count_outcomes(flown.random_results()));
  summary["random_flights"]["seed"] = seed;
  summary["given_flights"] = outcome_json(count_outcomes(flown.given_results()));
  summary["recorded_flights"] = flown.recorded.size();
  summary["final_legs"] = final_legs_json(flown.final_legs);
}

std::string flight_words(std::span<const State> starts, const ManyFlights& flown,
                         const std::string& drawn) {
  std::string text;
  constexpr std::size_t most_listed = 20;
  for (std::size_t i = 0; i < starts.size() && starts.size() <= most_listed; ++i) {
    const State& s = starts[i];
    const FlightResult& r = flown.results[i];
    text += fmt::format("({}, {}, {:g} rad): {}", coordinate_text(s.position_m.x),
                        coordinate_text(s.position_m.y), s.heading.rad(), name_of(r.outcome));
    if (std::isfinite(r.time_s))
      text += fmt::format(" after {:.2f} s, {:.1f} m", r.time_s, r.length_m);
    text += "\n";
  }
  text += fmt::format("Of {}{}, {}.", plural(starts.size(), "flight"), drawn,
                      outcome_words(count_outcomes(flown.results)));
  const std::string legs = final_legs_words(flown.final_legs);
  return legs.empty() ? text : text + "\n" + legs;
}

json flight_json(std::span<const State> starts, const ManyFlights& flown) {
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
  }
  json all = outcome_json(count_outcomes(flown.results));
  all["final_legs"] = final_legs_json(flown.final_legs);
  all["flights"] = std::move(flights);
  return all;
}

}  // namespace fairway
