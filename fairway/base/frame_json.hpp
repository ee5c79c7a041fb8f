// A frame in the records of plans and certificates (docs/formats.md).
// Private to the library: nlohmann/json is not part of its interface.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "fairway/base/frame.hpp"

namespace fairway {

[[nodiscard]] nlohmann::json json_of(const Frame& frame);

/// Throws InputError{where, ...} when `value` is not a frame.
[[nodiscard]] Frame frame_of(const nlohmann::json& value, const std::string& where);

}  // namespace fairway
