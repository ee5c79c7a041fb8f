// The scenario's key verify.region: how it is taken from TOML, and shown as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "fairway/run/region_request.hpp"
#include "fairway/run/toml_value.hpp"

namespace fairway {

/// Throws InputError as TomlValue::refuse does.
void take(const TomlValue& v, RegionRequest& x);

[[nodiscard]] nlohmann::json shown(const RegionRequest& x);

}  // namespace fairway
