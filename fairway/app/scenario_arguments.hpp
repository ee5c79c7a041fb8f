// A command's scenario and the options that override its values.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "fairway/run/scenario.hpp"

namespace fairway {

struct ScenarioArguments {
  std::filesystem::path file;
  std::vector<std::string> set;

  /// Of --set.
  [[nodiscard]] std::vector<ScenarioOverride> overrides() const;

  /// The scenario with --set, and then with `more`. Throws InputError.
  [[nodiscard]] Scenario read(const std::vector<ScenarioOverride>& more = {}) const;
};

/// Declares SCENARIO.toml and --set. `arguments` must outlive `options`.
void declare(CLI::App& options, ScenarioArguments& arguments);

}  // namespace fairway
