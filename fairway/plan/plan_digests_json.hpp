// The digests of a plan's arrays as certificates and bitmaps record them.
// Private to the library: nlohmann/json is not part of its interface.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "fairway/plan/plan_digests.hpp"

namespace fairway {

/// Throws InputError{where, ...} when `value` is not what json_text() writes.
[[nodiscard]] PlanDigests plan_digests_of_json(const nlohmann::json& value,
                                               const std::string& where);

}  // namespace fairway
