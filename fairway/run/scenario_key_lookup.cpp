#include "fairway/run/scenario_key_lookup.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/edit_distance.hpp"
#include "fairway/base/error.hpp"

namespace fairway {
namespace {

/// "; did you mean NAME?" for the nearest known name, or the known names when none is near.
std::string suggestion(std::string_view wrong, const std::vector<std::string>& known) {
  const auto distance = [&](const std::string& name) {
    return edit_distance(wrong.substr(0, 64), name);
  };
  const auto leaf = [](const std::string& name) { return name.substr(name.rfind('.') + 1); };
  const std::string* best = nullptr;
  for (const std::string& name : known) {
    if (leaf(name) == wrong.substr(wrong.rfind('.') + 1)) return "; did you mean " + name + "?";
    if (best == nullptr || distance(name) < distance(*best)) best = &name;
  }
  if (best != nullptr && distance(*best) <= 3) return "; did you mean " + *best + "?";
  return {};
}

}  // namespace

const ScenarioKey& scenario_key(const std::string& name, const std::string& place) {
  const auto& keys = scenario_keys();
  const auto key =
      std::find_if(keys.begin(), keys.end(), [&](const ScenarioKey& k) { return k.name == name; });
  if (key == keys.end()) refuse_unknown_key(name, place);
  return *key;
}

void refuse_unknown_key(const std::string& name, const std::string& place) {
  std::vector<std::string> names;
  std::set<std::string> tables;
  for (const ScenarioKey& key : scenario_keys()) {
    names.push_back(key.name);
    tables.insert(key.table());
    if (key.table() == name) {
      throw InputError(place, fmt::format("{}: is a table, expected one of its keys, such as {}",
                                          name, key.name));
    }
  }
  const bool is_table = name.find('.') == std::string::npos;
  for (const std::string& table : tables) {
    if (is_table || table.find('.') != std::string::npos) names.insert(names.begin(), table);
  }
  throw InputError(place, fmt::format("{}: there is no such key{}", name, suggestion(name, names)));
}

}  // namespace fairway
