// A vehicle in plan files and pages (docs/formats.md).
// Private to the library: nlohmann/json is not part of its interface.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

[[nodiscard]] nlohmann::json json_of(const Vehicle& vehicle);

/// Throws InputError{where, ...} when `value` is not a vehicle.
[[nodiscard]] Vehicle vehicle_of(const nlohmann::json& value, const std::string& where);

}  // namespace fairway
