// JSON from outside, read strictly: refuses deep nesting, repeated keys and non-finite numbers.
// Private to the library: nlohmann/json is not part of its interface.
#pragma once

#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace fairway {

struct JsonLimits {
  std::size_t most_members = std::numeric_limits<std::size_t>::max();  ///< of an object
  int deepest = 32;                                                    ///< levels
};

/// Throws InputError{where, ...} for text that is not one JSON value, repeats a key in an object,
/// nests deeper or has an object of more members than it may; `where` with the line for broken
/// syntax in a text of several lines. Cost: linear in the text.
[[nodiscard]] nlohmann::json parse_strict_json(std::string_view text, const std::string& where,
                                               const JsonLimits& limits = {});

/// A value for an error message, shortened when long.
[[nodiscard]] std::string shown(const nlohmann::json& value);

/// Members of an object, with errors that name them. `where` is where the object is.
const nlohmann::json& member(const nlohmann::json& object, const char* key,
                             const std::string& where);
double finite_number(const nlohmann::json& object, const char* key, const std::string& where);
std::string text_member(const nlohmann::json& object, const char* key, const std::string& where);
/// Refuses keys that are not in `known`.
void require_known_keys(const nlohmann::json& object, std::initializer_list<std::string_view> known,
                        const std::string& where);

}  // namespace fairway
