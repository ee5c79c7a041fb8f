#include "fairway/tune/parameter_search.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/run/edited_scenario.hpp"
#include "fairway/run/run.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/scenario_text.hpp"
#include "fairway/tune/search.hpp"
#include "fairway/tune/tuning_products.hpp"

namespace fairway {
namespace {

using nlohmann::json;

std::string shown_text(const Scenario& scenario, const std::string& key) {
  for (const ScenarioKey& k : scenario_keys()) {
    if (k.name != key) continue;
    const json shown = k.shown(scenario);
    if (shown.is_null()) {
      throw InputError("--vary", key + ": has no value in this scenario; give it one");
    }
    return shown.is_number_float() ? fmt::format("{}", shown.get<double>())
           : shown.is_string()     ? shown.get<std::string>()
                                   : shown.dump();
  }
  throw InputError("--vary", key + ": there is no such key");
}

std::vector<Values> combinations_of(const std::vector<Parameter>& parameters) {
  std::vector<Values> all{{}};
  for (const Parameter& p : parameters) {
    if (p.is_range()) continue;
    std::vector<Values> longer;
    for (const Values& so_far : all) {
      for (const std::string& choice : p.choices) {
        longer.push_back(so_far);
        longer.back().push_back(choice);
      }
    }
    all = std::move(longer);
  }
  return all;
}

}  // namespace

TunedScenario::TunedScenario(const TuneRequest& request) : request_(request) {
  use_toml_file(request.scenario, [&](std::string_view text) {
    text_ = std::string(text);
    given_ = scenario_of_text(text, request.scenario, request.overrides);
  });
  parameters_ = request.parameters.empty() ? usual_parameters(given_) : request.parameters;
}

Values TunedScenario::keys() const {
  Values keys;
  for (const Parameter& p : parameters_) keys.push_back(p.key);
  return keys;
}

std::vector<ScenarioOverride> TunedScenario::overrides(const Values& values) const {
  std::vector<ScenarioOverride> all = request_.overrides;
  for (std::size_t i = 0; i < values.size(); ++i) {
    all.push_back({parameters_[i].key, values[i], "--vary"});
  }
  return all;
}

Scenario TunedScenario::with(const Values& values) const {
  return scenario_of_text(text_, request_.scenario, overrides(values));
}

std::string TunedScenario::text_in(const std::filesystem::path& folder,
                                   const Values& values) const {
  return edited_scenario(text_, request_.scenario, overrides(values), folder);
}

ParameterSearch::ParameterSearch(const TuneRequest& request, const TunedScenario& tuned,
                                 const std::filesystem::path& folder, StageClock& clock)
    : request_(request),
      tuned_(tuned),
      clock_(clock),
      log_(folder / tuning_product::evaluations, tuned.keys()),
      began_(std::chrono::steady_clock::now()) {}

/// As its plan has them.
Values ParameterSearch::given_values() const {
  const Progress silent;
  StageClock own(silent);
  Scenario scenario = tuned_.given();
  scenario.improve = false;  // changes no parameter, nor do modes
  scenario.open.modes = false;
  const auto answer = plan_scenario(scenario, own);
  const auto* planned = std::get_if<Planned>(&answer);
  Values values;
  for (const Parameter& p : tuned_.parameters()) {
    values.push_back(shown_text(planned != nullptr ? planned->scenario : tuned_.given(), p.key));
  }
  return values;
}

void ParameterSearch::run() {
  given_ = *find_or_evaluate(given_values());
  const std::vector<Values> combinations = combinations_of(tuned_.parameters());
  const auto to_come = static_cast<std::size_t>(request_.evaluations - 1);
  for (std::size_t i = 0; i < combinations.size(); ++i) {
    until_ = 1 + to_come * (i + 1) / combinations.size();
    search_with(combinations[i]);
  }
}

Values ParameterSearch::values_at(std::span<const double> place, const Values& chosen) const {
  Values values;
  std::size_t range = 0;
  std::size_t choice = 0;
  for (const Parameter& p : tuned_.parameters()) {
    values.push_back(p.is_range() ? value_text(p.low + (p.high - p.low) * place[range++])
                                  : chosen[choice++]);
  }
  return values;
}

void ParameterSearch::search_with(const Values& chosen) {
  std::vector<double> start;
  for (std::size_t i = 0; i < tuned_.parameters().size(); ++i) {
    const Parameter& p = tuned_.parameters()[i];
    if (!p.is_range()) continue;
    const double at = (std::stod(given_.values[i]) - p.low) / (p.high - p.low);
    start.push_back(std::clamp(at, 0.0, 1.0));
  }
  if (start.empty()) {
    find_or_evaluate(values_at({}, chosen));
    return;
  }
  const std::size_t left = until_ > asked_.size() ? until_ - asked_.size() : 0;
  // Rounded values repeat: they cost nothing, but must not go on for ever.
  const int questions = static_cast<int>(4 * left) + 1;
  int asked = 0;
  search_box(start, static_cast<int>(left) + 1,
             [&](std::span<const double> place) -> std::optional<double> {
               const Evaluation* one =
                   ++asked > questions ? nullptr : find_or_evaluate(values_at(place, chosen));
               return one == nullptr ? std::nullopt : std::optional(value(*one));
             });
}

const Evaluation* ParameterSearch::find_or_evaluate(const Values& values) {
  const auto known = std::find_if(asked_.begin(), asked_.end(),
                                  [&](const Evaluation& e) { return e.values == values; });
  if (known != asked_.end()) return &*known;
  const Evaluation* logged = log_.find(values);
  if (!asked_.empty() && asked_.size() >= until_) return nullptr;
  if (logged == nullptr) {
    const bool is_late = request_.time_limit_s > 0.0 && seconds() >= request_.time_limit_s;
    if (!asked_.empty() && is_late) return nullptr;
    tell();
    Scenario scenario = tuned_.with(values);
    scenario.improve = false;  // takes far longer than an evaluation; finalists have it
    logged = &log_.add(evaluate(scenario, values));
  }
  asked_.push_back(*logged);
  return &asked_.back();
}

double ParameterSearch::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}
void ParameterSearch::tell() {
  ++evaluated_;
  double best = 0.0;
  for (const Evaluation& one : asked_) best = std::max(best, one.share);
  clock_.rename(fmt::format("searching, {} of {}, best {}", asked_.size() + 1, request_.evaluations,
                            percent_text(best, 1)));
  const auto to_come =
      static_cast<double>(request_.evaluations) - static_cast<double>(asked_.size());
  clock_.tell(seconds() / static_cast<double>(evaluated_) * to_come);
}

}  // namespace fairway
