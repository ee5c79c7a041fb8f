#include "fairway/base/strict_json.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "fairway/base/error.hpp"

namespace fairway {

using nlohmann::json;

json parse_strict_json(std::string_view text, const std::string& where) {
  constexpr int deepest = 32;
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto look = [&](int depth, json::parse_event_t event, json& parsed) {
    if (depth > deepest) throw InputError(where, "nests more than 32 levels of JSON");
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key &&
        !keys.back().insert(parsed.get_ref<const std::string&>()).second) {
      throw InputError(where, "has the key \"" + parsed.get<std::string>() + "\" twice");
    }
    return true;
  };
  try {
    return json::parse(text.begin(), text.end(), look);
  } catch (const json::exception& error) {
    throw InputError(where, std::string("is not JSON: ") + error.what());
  }
}

std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', true);
  constexpr std::size_t longest = 60;
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

const json& member(const json& object, const char* key, const std::string& where) {
  if (!object.is_object()) throw InputError(where, "expected a JSON object");
  const auto found = object.find(key);
  if (found == object.end()) {
    throw InputError(where, std::string("lacks the key \"") + key + "\"");
  }
  return *found;
}

double finite_number(const json& object, const char* key, const std::string& where) {
  const json& value = member(object, key, where);
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw InputError(where + "." + key, "expected a finite number, found " + shown(value));
  }
  return value.get<double>();
}

std::string text_member(const json& object, const char* key, const std::string& where) {
  const json& value = member(object, key, where);
  if (!value.is_string()) {
    throw InputError(where + "." + key, "expected a string, found " + shown(value));
  }
  return value.get<std::string>();
}

void require_known_keys(const json& object, std::initializer_list<std::string_view> known,
                        const std::string& where) {
  if (!object.is_object()) throw InputError(where, "expected a JSON object");
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw InputError(where, "has the unknown key \"" + key + "\"");
    }
  }
}

}  // namespace fairway
