// Values of scenario keys from the command line: `--set map.cell_m=4`.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "fairway/run/scenario.hpp"

namespace fairway {

/// `KEY=VALUE`. Throws InputError, without a place, when it has no key or no value.
[[nodiscard]] ScenarioOverride override_of_text(const std::string& text);

/// Overrides the scenario's value. Throws InputError{option, ...} for a key that does not exist and
/// for an invalid value.
void take_override(const ScenarioOverride& one, Scenario& scenario);

/// Adds "set" to a summary: the values from the command line, key by key; only if there are any.
void add_overrides(nlohmann::json& summary, const Scenario& scenario);

}  // namespace fairway
