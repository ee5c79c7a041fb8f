// scenario -> the scenario with the best parameters, and the evidence for it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "fairway/run/progress.hpp"
#include "fairway/run/run.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/tune/evaluation.hpp"
#include "fairway/tune/parameter.hpp"

namespace fairway {

struct TuneRequest {
  std::filesystem::path scenario;
  std::vector<ScenarioOverride> overrides;
  std::vector<Parameter> parameters;  ///< empty: the usual ones
  Objective objective;
  int evaluations = 200;
  double time_limit_s = 0.0;  ///< of the search; 0: none
  int finalists = 3;          ///< proved sharply, with the scenario as given
  bool resume = false;        ///< from the folder's evaluations.csv
};

/// Searches coarsely, proves the best few sharply and the scenario as given, and keeps the one of
/// the highest value, of proved shares and flown times. The folder gets scenario.toml, its plan and
/// certificate, pictures and summary.json at the end, in one step; evaluations.csv and search.json
/// are there from the beginning, and what was evaluated is not evaluated again when resumed.
/// Depends on the request alone, not on threads, unless a limit of time ends the search or a proof.
/// Throws InputError.
[[nodiscard]] RunResult tune(const TuneRequest& request, const std::filesystem::path& folder,
                             Existing existing, const Progress& progress);

}  // namespace fairway
