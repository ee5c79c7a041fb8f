// THE main flow: from a scenario to a folder with all products.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/base/atomic_file.hpp"
#include "fairway/run/plan_scenario.hpp"
#include "fairway/run/progress.hpp"
#include "fairway/run/scenario.hpp"

namespace fairway {

struct RunResult {
  bool unreachable = false;  ///< nothing was written; `paragraph` says why
  nlohmann::json summary;    ///< docs/formats.md
  std::string paragraph;     ///< the result in words
  std::vector<std::string> warnings;
};

/// map -> field -> plan -> flights -> pictures -> summary.json, all in `folder`, which appears
/// whole or not at all. Products do not depend on threads, but for the times in summary.json.
/// Throws InputError for bad input, a mission the map does not allow, or an existing output.
[[nodiscard]] RunResult run(const Scenario& scenario, const std::filesystem::path& folder,
                            Existing existing, const Progress& progress);

/// map -> field -> plan alone, into one file, and into a picture where one is named.
[[nodiscard]] RunResult run_plan_only(const Scenario& scenario, const std::filesystem::path& file,
                                      Existing existing, const Progress& progress,
                                      const std::filesystem::path& picture = {});

}  // namespace fairway
