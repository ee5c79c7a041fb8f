// What behaviours came to, in words and as JSON.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/run/flight_summary.hpp"
#include "fairway/run/fly_behaviours.hpp"
#include "fairway/vehicle/contract_json.hpp"

namespace fairway {
namespace {

struct StartCounts {
  std::size_t fail = 0;
  std::size_t proved = 0;   ///< of those, with a flight that proves it
  std::size_t endless = 0;  ///< none fails, but one meets no end
  std::size_t collide = 0;  ///< the worst flight of those that fail
  std::size_t leave = 0;
};

StartCounts counts_of(const FlownBehaviours& flown) {
  StartCounts counts;
  for (std::size_t i = 0; i < flown.worst.size(); ++i) {
    const Outcome worst = flown.worst[i].result.outcome;
    counts.collide += worst == Outcome::collide ? 1 : 0;
    counts.leave += worst == Outcome::leave ? 1 : 0;
    counts.endless += worst == Outcome::trapped ? 1 : 0;
    counts.proved += flown.outcomes[i].proved_failure ? 1 : 0;
  }
  counts.fail = counts.collide + counts.leave;
  return counts;
}

std::string names_of(const std::vector<Adversary>& adversaries) {
  std::string names;
  for (const Adversary adversary : adversaries) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name_of(adversary));
  }
  return names;
}

std::string start_words(const FlownBehaviours& flown, std::size_t i) {
  const Flight& worst = flown.worst[i];
  const OutcomeCounts& counts = flown.outcomes[i].counts;
  std::string text =
      fmt::format("({}, {}, {:g} rad): ", coordinate_text(worst.start.position_m.x),
                  coordinate_text(worst.start.position_m.y), worst.start.heading.rad());
  std::string parts;
  for (const Outcome outcome :
       {Outcome::collide, Outcome::leave, Outcome::trapped, Outcome::reach}) {
    if (counts.of(outcome) == 0) continue;
    parts +=
        fmt::format("{}{} {}", parts.empty() ? "" : ", ", counts.of(outcome), name_of(outcome));
  }
  text += fmt::format("of {}, {}", plural(flown.each, "behaviour"), parts);
  if (std::isfinite(worst.result.time_s)) {
    text += fmt::format("; the worst: {} after {:.2f} s, {:.1f} m", name_of(worst.result.outcome),
                        worst.result.time_s, worst.result.length_m);
  }
  if (flown.outcomes[i].proved_failure) text += "; at risk, proved by a flight";
  return text + "\n";
}

}  // namespace

std::string behaviour_words(const FlownBehaviours& flown, const std::string& drawn) {
  std::string text;
  constexpr std::size_t most_listed = 20;
  std::vector<std::size_t> order(flown.worst.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto rank = [&](std::size_t i) {  // what fails, then what meets no end
    const Outcome worst = flown.worst[i].result.outcome;
    return worst == Outcome::reach ? 2 : worst == Outcome::trapped ? 1 : 0;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  if (order.size() <= most_listed) {
    for (const std::size_t i : order) text += start_words(flown, i);
  }
  const StartCounts counts = counts_of(flown);
  const std::size_t starts = flown.worst.size();
  text += fmt::format("Of {}{}, ", plural(starts, "start"), drawn);
  if (counts.fail == 0) {
    text += fmt::format("none fails under {} each.", plural(flown.each, "behaviour"));
  } else {
    text += fmt::format(
        "{} ({}) {} under some behaviour within the contract: {} collide, {} leave "
        "the map. Proved, by a flight that keeps the contract throughout: {}.",
        grouped(counts.fail), percent_text(counts.fail, starts),
        counts.fail == 1 ? "fails" : "fail", grouped(counts.collide), grouped(counts.leave),
        grouped(counts.proved));
  }
  if (counts.endless > 0) {
    text += fmt::format(" From {}, none fails but some meet no end.", grouped(counts.endless));
  }
  const std::size_t rest = starts - counts.fail - counts.endless;
  if (rest > 0) {
    text += fmt::format(" From {}, all {} reach ({}): evidence, not a proof.", grouped(rest),
                        plural(flown.each, "behaviour"), names_of(flown.adversaries));
  }
  return text;
}

nlohmann::json behaviour_json(const FlownBehaviours& flown, const EarthFrame* earth) {
  using nlohmann::json;
  const StartCounts counts = counts_of(flown);
  json all = {{"contract", json_of(flown.contract)},
              {"behaviours", flown.each},
              {"adversaries", json::array()},
              {"starts", flown.worst.size()},
              {"fail", counts.fail},
              {"at_risk", counts.proved},
              {"endless", counts.endless}};
  for (const Adversary adversary : flown.adversaries) {
    all["adversaries"].push_back(name_of(adversary));
  }
  json flights = json::array();
  for (std::size_t i = 0; i < flown.worst.size(); ++i) {
    const Flight& worst = flown.worst[i];
    const bool ends = std::isfinite(worst.result.time_s);
    json one = {{"x_m", worst.start.position_m.x},
                {"y_m", worst.start.position_m.y},
                {"heading_rad", worst.start.heading.rad()},
                {"outcome", name_of(worst.result.outcome)},
                {"time_s", ends ? json(worst.result.time_s) : json()},
                {"length_m", ends ? json(worst.result.length_m) : json()},
                {"at_risk", flown.outcomes[i].proved_failure}};
    for (const Outcome outcome : outcomes_in_order) {
      one["behaviours"][name_of(outcome)] = flown.outcomes[i].counts.of(outcome);
    }
    if (earth != nullptr) add_degrees(one, worst.start, *earth);
    flights.push_back(std::move(one));
  }
  all["flights"] = std::move(flights);
  return all;
}

}  // namespace fairway
