#include "fairway/run/plan_warnings.hpp"

#include <utility>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fairway/base/share_text.hpp"
#include "fairway/run/contract_warning.hpp"
#include "fairway/run/passage_words.hpp"
#include "fairway/run/summary.hpp"

namespace fairway {
namespace {

using namespace nlohmann::literals;

/// The buffer's width in turning radii, where the plan says it.
std::optional<double> alpha_of(const Plan& plan) {
  if (plan.record.options_json.empty()) return std::nullopt;
  const auto options = nlohmann::json::parse(plan.record.options_json);
  const nlohmann::json alpha = options.value("/plan/alpha"_json_pointer, nlohmann::json());
  return alpha.is_number() ? std::optional(alpha.get<double>()) : std::nullopt;
}

}  // namespace

std::optional<std::string> cut_off_warning(const Plan& plan, const std::string& remedy) {
  const RegionCells cells = count_regions(plan);
  if (static_cast<double>(cells.unreachable) <=
      most_cut_off_unwarned * static_cast<double>(cells.free)) {
    return std::nullopt;
  }
  const std::string warning = fmt::format(
      "{} of the free cells ({} of {}) are cut off from the {}: no way through free cells leads "
      "to it, so {}.",
      percent_text(cells.unreachable, cells.free), grouped(cells.unreachable), grouped(cells.free),
      goal_word(plan),
      plan.record.holding_places.empty()
          ? "they have no command and a vehicle in them flies straight on"
          : "a vehicle in them can only wait there, on a circle, where one fits");
  return remedy.empty() ? warning : warning + " " + remedy;
}

std::optional<std::string> failing_warning(const Plan& plan,
                                           const OutcomeCounts& starts_with_command) {
  const OutcomeCounts& counts = starts_with_command;
  const std::size_t failing = counts.total() - counts.of(Outcome::reach);
  if (static_cast<double>(failing) <= most_failing_unwarned * static_cast<double>(counts.total())) {
    return std::nullopt;
  }
  std::string warning = fmt::format(
      "{} of {} from safe starts with a command do not reach the {} ({}): such a start has room to "
      "turn, but where the commands turn faster than the vehicle can, a flight cannot follow them.",
      sampled_share(failing, counts.total()).share, plural(counts.total(), "random flight"),
      goal_word(plan), failure_words(counts));
  const std::optional<double> alpha = alpha_of(plan);
  if (alpha && *alpha < 2.0) {
    warning +=
        fmt::format(" plan.alpha is {:g}: below 2, there may be no room for a full turn.", *alpha);
  }
  return warning;
}

std::vector<std::string> plan_warnings(const Scenario& scenario, const ObstacleMap& map,
                                       const Plan& plan) {
  std::vector<std::string> warnings = map.warnings;
  if (cut_off_warning(plan)) {
    const std::string passage = passage_words(cut_off_in(scenario, map, plan), map.frame);
    warnings.push_back(*cut_off_warning(plan, passage));
  }
  if (scenario.improve && !plan.record.improved) {
    warnings.push_back("plan.improve: no better commands were found; the plan is as it was.");
  }
  if (plan.record.contract) {
    if (auto warning = contract_warning(plan, *plan.record.contract)) {
      warnings.push_back(std::move(*warning));
    }
  }
  return warnings;
}

}  // namespace fairway
