// Values of scenario keys from the command line: `--set map.cell_m=4`.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "fairway/run/scenario.hpp"

namespace fairway {

/// `KEY=VALUE`. Throws InputError, without a place, when it has no key or no value.
[[nodiscard]] ScenarioOverride override_of_text(const std::string& text);

/// Puts the value in place of what the scenario has. Throws InputError{option, ...} for a key that
/// does not exist and for a value that it cannot have.
void take_override(const ScenarioOverride& one, Scenario& scenario);

/// "set": what the command line gave, key by key, into a summary; nothing when it gave nothing.
void add_overrides(nlohmann::json& summary, const Scenario& scenario);

}  // namespace fairway
