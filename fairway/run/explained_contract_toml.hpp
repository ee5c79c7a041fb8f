// A contract as a TOML block whose comments say where each number comes from.
#pragma once

#include <string>

#include "fairway/identify/explained_contract.hpp"

namespace fairway {

/// What contract_toml() writes, with the reasons as comments above the keys.
[[nodiscard]] std::string explained_contract_toml(const ExplainedContract& explained);

}  // namespace fairway
