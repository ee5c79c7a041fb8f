// The numbers of a reproduction, as Markdown to read and as JSON to compare.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "reproduce/figures.hpp"

namespace fairway::reproduce {

[[nodiscard]] std::string tables_of(const Reproduction& reproduction);
[[nodiscard]] nlohmann::json numbers_of(const Reproduction& reproduction);

}  // namespace fairway::reproduce
