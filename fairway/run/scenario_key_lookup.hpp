// Finds a scenario key by name, and suggests one for an unknown name.
#pragma once

#include <string>

#include "fairway/run/scenario_keys.hpp"

namespace fairway {

/// The key called "TABLE.LEAF". Throws InputError{place, ...} with a suggestion.
[[nodiscard]] const ScenarioKey& scenario_key(const std::string& name, const std::string& place);

/// Of a key or a table that does not exist.
[[noreturn]] void refuse_unknown_key(const std::string& name, const std::string& place);

}  // namespace fairway
