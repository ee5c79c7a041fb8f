#include "fairway/run/scenario_overrides.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "fairway/base/error.hpp"
#include "fairway/run/scenario_key_lookup.hpp"
#include "fairway/run/toml_value.hpp"

namespace fairway {
namespace {

/// { value = ... }. Text that is not a TOML value is taken as a string without quotes, unless it
/// begins with an opening quote or bracket.
toml::table parsed(const ScenarioOverride& one) {
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 127; };
  if (std::any_of(one.value.begin(), one.value.end(), is_control)) {
    throw InputError(one.option,
                     fmt::format("{}: contains a control character, expected a value", one.key));
  }
  try {
    return toml::parse("value = " + one.value);
  } catch (const toml::parse_error& error) {
    if (std::string_view("\"'[{").find(one.value.front()) != std::string_view::npos) {
      throw InputError(one.option, fmt::format("{}: {} is not TOML: {}", one.key, one.value,
                                               error.description()));
    }
  }
  toml::table table;
  table.insert("value", one.value);
  return table;
}

}  // namespace

ScenarioOverride override_of_text(const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const auto trimmed = [](std::string part) {
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    return part;
  };
  ScenarioOverride one{trimmed(text.substr(0, equals)),
                       trimmed(text.substr(std::min(equals + 1, text.size())))};
  if (one.key.empty() || one.value.empty()) {
    throw InputError("", "expected KEY=VALUE, such as map.cell_m=4.0");
  }
  return one;
}

void take_override(const ScenarioOverride& one, Scenario& scenario) {
  const ScenarioKey& key = scenario_key(one.key, one.option);
  const toml::table table = parsed(one);
  key.take(TomlValue(*table.get("value"), {one.option, false}, one.key, key.range), scenario);
  scenario.lines[one.key] = 0;
  scenario.options[one.key] = one.option;
}

void add_overrides(nlohmann::json& summary, const Scenario& scenario) {
  for (const auto& [key, option] : scenario.options) {
    summary["set"][key] = scenario_key(key, option).shown(scenario);
  }
}

}  // namespace fairway
