// The search for the best parameters of a scenario, which logs what it evaluates.
#pragma once

#include <chrono>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fairway/run/scenario.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/tune/evaluation.hpp"
#include "fairway/tune/parameter.hpp"
#include "fairway/tune/tune.hpp"

namespace fairway {

using Values = std::vector<std::string>;  ///< of the parameters, as TOML writes them

/// A scenario as text, so that others can be made of it.
class TunedScenario {
 public:
  explicit TunedScenario(const TuneRequest& request);

  const Scenario& given() const { return given_; }
  const std::vector<Parameter>& parameters() const { return parameters_; }
  [[nodiscard]] Values keys() const;
  [[nodiscard]] Scenario with(const Values& values) const;
  /// To lie in `folder`.
  [[nodiscard]] std::string text_in(const std::filesystem::path& folder,
                                    const Values& values) const;

 private:
  [[nodiscard]] std::vector<ScenarioOverride> overrides(const Values& values) const;

  const TuneRequest& request_;
  std::string text_;
  Scenario given_;
  std::vector<Parameter> parameters_;
};

class ParameterSearch {
 public:
  /// The log in `folder` answers what it has. All arguments must outlive this.
  ParameterSearch(const TuneRequest& request, const TunedScenario& tuned,
                  const std::filesystem::path& folder, StageClock& clock);

  /// The scenario as given, then over the ranges, for each combination of choices with its part of
  /// the evaluations.
  void run();

  /// In the order of the search, each once; first the scenario as given.
  const std::vector<Evaluation>& asked() const { return asked_; }
  double value(const Evaluation& one) const { return value_of(one, given_, request_.objective); }

 private:
  [[nodiscard]] Values given_values() const;
  [[nodiscard]] Values values_at(std::span<const double> place, const Values& chosen) const;
  void search_with(const Values& chosen);
  /// Null: the evaluations or the time are over.
  const Evaluation* find_or_evaluate(const Values& values);
  double seconds() const;
  void tell();

  const TuneRequest& request_;
  const TunedScenario& tuned_;
  StageClock& clock_;
  EvaluationLog log_;
  std::chrono::steady_clock::time_point began_;
  Evaluation given_;
  std::vector<Evaluation> asked_;
  std::size_t until_ = 1;  ///< so many may be asked so far
  int evaluated_ = 0;
};

}  // namespace fairway
