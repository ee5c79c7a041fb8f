// A vehicle contract in the records of plans and certificates (docs/formats.md).
// Private to the library: nlohmann/json is not part of its interface.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "fairway/vehicle/contract.hpp"

namespace fairway {

/// Every member, ranges as [least, most].
[[nodiscard]] nlohmann::json json_of(const VehicleContract& contract);

/// Throws InputError{where, ...} when `value` is not what json_of() writes. Whether the numbers
/// make sense is for require_contract() to say.
[[nodiscard]] VehicleContract contract_of(const nlohmann::json& value, const std::string& where);

}  // namespace fairway
