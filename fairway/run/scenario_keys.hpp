// The table of scenario keys: name, kind, range, default, meaning, and how each is read. The
// reader, the documentation and the record in every product are all made from this table.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/run/scenario.hpp"
#include "fairway/run/toml_value.hpp"

namespace fairway {

struct ScenarioKey {
  std::string name;  ///< "map.cell_m"
  std::string kind;  ///< "number > 0", "\"goal\" or \"path\"", ...
  Range range;       ///< of every number in the value
  bool required = false;
  std::string meaning;  ///< one phrase
  std::function<void(const TomlValue&, Scenario&)> take;
  std::function<nlohmann::json(const Scenario&)> shown;  ///< null: not given

  [[nodiscard]] std::string table() const { return name.substr(0, name.rfind('.')); }
  [[nodiscard]] std::string leaf() const { return name.substr(name.rfind('.') + 1); }
};

/// All keys, table by table, in the order of the documentation.
[[nodiscard]] const std::vector<ScenarioKey>& scenario_keys();

/// The documentation's table, Markdown.
[[nodiscard]] std::string scenario_keys_markdown();

/// Effective values of the keys of one table: {"alpha": 2.0, ...}. Those of "vehicle" have a
/// "contract" if the scenario has one.
[[nodiscard]] nlohmann::json effective_values(const Scenario& scenario, std::string_view table);

}  // namespace fairway
