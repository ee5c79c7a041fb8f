// The grammar of a plan's record. Private to the library: nlohmann/json is not part of its
// interface.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "fairway/plan/plan_record.hpp"

namespace fairway {

[[nodiscard]] nlohmann::json json_of(const PlanRecord& record);

/// Throws InputError{where, ...} when a member known to Fairway is damaged. `value` is an object.
[[nodiscard]] PlanRecord plan_record_of(nlohmann::json value, const std::string& where);

}  // namespace fairway
