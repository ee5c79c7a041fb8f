// A mission in the records of plans and pages (docs/formats.md).
// Private to the library: nlohmann/json is not part of its interface.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "fairway/vehicle/mission.hpp"

namespace fairway {

[[nodiscard]] nlohmann::json json_of(const Mission& mission);

/// Throws InputError{where, ...} when `value` is not a mission.
[[nodiscard]] Mission mission_of(const nlohmann::json& value, const std::string& where);

}  // namespace fairway
