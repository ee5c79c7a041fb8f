// A ceiling in numbers and in words, and what share of it a plan keeps.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "fairway/ceiling/ceiling.hpp"

namespace fairway {

/// `ceiling`, `ceiling_free`, `ceiling_buffer` as [lower, upper], and how they were found.
[[nodiscard]] nlohmann::json json_of(const Ceiling& ceiling);
[[nodiscard]] std::string words_of(const Ceiling& ceiling);

/// Of what any control could keep, the share that a plan of which `proved` of all states are proved
/// keeps at least: against the upper bound.
[[nodiscard]] double share_of_ceiling(const Ceiling& ceiling, double proved);

}  // namespace fairway
