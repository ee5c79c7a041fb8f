// Keys of a scenario by the kind of their value. Private to scenario_keys.cpp.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/scenario_values.hpp"

namespace fairway {

/// A key for a member of Scenario, reached by `member`.
template <typename Member>
[[nodiscard]] ScenarioKey key(std::string name, std::string kind, Range range, Member member,
                              std::string meaning) {
  return {std::move(name),
          std::move(kind),
          range,
          false,
          std::move(meaning),
          [member](const TomlValue& v, Scenario& s) { take(v, member(s)); },
          [member](const Scenario& s) { return shown(member(s)); }};
}

template <typename Member>
[[nodiscard]] ScenarioKey number(std::string name, Range range, Member member,
                                 std::string meaning) {
  return key(std::move(name), "number " + range.text(), range, member, std::move(meaning));
}

template <typename Member>
[[nodiscard]] ScenarioKey whole(std::string name, Range range, Member member, std::string meaning) {
  return key(std::move(name), "whole number " + range.text(), range, member, std::move(meaning));
}

/// A key with one of a few names as its value.
template <typename T, typename Member>
[[nodiscard]] ScenarioKey choice(std::string name, std::vector<std::pair<std::string, T>> choices,
                                 Member member, std::string meaning) {
  std::string kind;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) kind += i + 1 == choices.size() ? " or " : ", ";
    kind += '"' + choices[i].first + '"';
  }
  const auto take_choice = [choices, member, kind](const TomlValue& v, Scenario& s) {
    const std::string text = v.text();
    for (const auto& [choice_name, value] : choices) {
      if (choice_name == text) {
        member(s) = value;
        return;
      }
    }
    v.refuse(kind);
  };
  const auto shown_choice = [choices, member](const Scenario& s) {
    for (const auto& [choice_name, value] : choices) {
      if (member(s) == value) return nlohmann::json(choice_name);
    }
    return nlohmann::json();
  };
  return {std::move(name), kind, Range{}, false, std::move(meaning), take_choice, shown_choice};
}

}  // namespace fairway
