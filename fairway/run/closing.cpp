#include "fairway/run/closing.hpp"

#include <utility>
#include <variant>

#include "fairway/run/final_legs.hpp"
#include "fairway/run/following_summary.hpp"
#include "fairway/run/plan_warnings.hpp"
#include "fairway/run/start_warnings.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/simulate/flight_statistics.hpp"

namespace fairway {
namespace {

using nlohmann::json;

std::string checked_words(bool checked) {
  return checked ? "An independent program re-proved the certificate."
                 : "The certificate was NOT checked: fairway-check could not be run.";
}

}  // namespace

std::string words_of(const Verified& verified) {
  if (std::holds_alternative<NotVerified>(verified)) return "Nothing was verified.";
  if (const auto* bitmap = std::get_if<BitmapVerification>(&verified)) {
    return verification_words(*bitmap);
  }
  const Proved& proved = std::get<Proved>(verified);
  return verification_words(proved.verification) + " " + checked_words(proved.checked);
}

std::vector<Finding> findings_of(const Plan& plan, const ScenarioFlights& flown,
                                 const Verified& verified) {
  std::vector<Finding> found;
  if (const auto* proved = std::get_if<Proved>(&verified)) {
    found = findings(plan, proved->verification);
  } else if (const auto* bitmap = std::get_if<BitmapVerification>(&verified)) {
    found = findings(plan, *bitmap);
  } else {
    found = plan_findings(plan);
  }
  for (Finding& finding : findings(plan, flown)) found.push_back(std::move(finding));
  return found;
}

std::vector<std::string> warnings_of(const Scenario& scenario, const ObstacleMap& map,
                                     const Plan& plan, const ScenarioFlights& flown,
                                     const Verified& verified) {
  std::vector<std::string> warnings = plan_warnings(scenario, map, plan);
  const auto random = count_outcomes(flown.random_results());
  if (auto warning = failing_warning(plan, random)) warnings.push_back(std::move(*warning));
  if (const auto* proved = std::get_if<Proved>(&verified)) {
    if (auto warning = limit_warning(proved->verification)) warnings.push_back(std::move(*warning));
  }
  for (std::string& warning : start_warnings(flown.given_starts(), plan)) {
    warnings.push_back(std::move(warning));
  }
  return warnings;
}

std::string notes_of(const Plan& plan, const ScenarioFlights& flown, const Verified& verified) {
  std::string notes;
  if (const auto* proved = std::get_if<Proved>(&verified)) {
    notes = proof_notes(proved->verification) + "\n" + checked_words(proved->checked) + "\n";
  } else {
    notes = words_of(verified) + "\n";
  }
  if (!flown.random_results().empty()) {
    notes += "Flights are evidence, not a proof; brackets give the 95 % interval of their share.\n";
  }
  if (const std::string legs = final_legs_words(flown.final_legs); !legs.empty()) {
    notes += legs + "\n";
  }
  const std::string onward =
      following_words(following_summary(flown, flown.random_results(), flown.random_measures()));
  if (!onward.empty()) notes += onward + "\n";
  return notes + grid_words(plan) + "\n";
}

json json_of(const Verified& verified) {
  if (std::holds_alternative<NotVerified>(verified)) {
    return {{"method", "none"}, {"proved", false}, {"words", words_of(verified)}};
  }
  const auto* proved = std::get_if<Proved>(&verified);
  json summary = proved != nullptr ? verification_json(proved->verification)
                                   : verification_json(std::get<BitmapVerification>(verified));
  if (proved != nullptr) summary["checked"] = proved->checked;
  summary["words"] = words_of(verified);
  return summary;
}

}  // namespace fairway
