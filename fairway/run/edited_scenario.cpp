#include "fairway/run/edited_scenario.hpp"

#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "fairway/base/error.hpp"
#include "fairway/run/scenario_keys.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using Values = std::vector<std::pair<std::string, std::string>>;  // key, value as TOML writes it

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin));
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream in{std::string(text)};
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// "plan" of "[plan]  # ..."; empty for other lines.
std::string table_in(const std::string& line) {
  const std::string bare = trimmed(line);
  if (bare.empty() || bare.front() != '[' || bare.find(']') == std::string::npos) return {};
  return trimmed(std::string_view(bare).substr(1, bare.find(']') - 1));
}

std::string leaf_in(const std::string& line) {
  const std::size_t equals = line.find('=');
  return equals == std::string::npos ? std::string() : trimmed(line.substr(0, equals));
}

/// The line with another value, its comment kept where no quote stands in the way.
std::string replaced(const std::string& line, const std::string& value) {
  const std::size_t equals = line.find('=');
  const std::string rest = line.substr(equals + 1);
  const std::size_t hash =
      rest.find_first_of("\"'") == std::string::npos ? rest.find('#') : std::string::npos;
  std::string made = line.substr(0, equals + 1) + " " + value;
  if (hash != std::string::npos) made += "  " + rest.substr(hash);
  return made;
}

void set(std::vector<std::string>& lines, const std::string& key, const std::string& value) {
  const std::string table = key.substr(0, key.rfind('.'));
  const std::string leaf = key.substr(key.rfind('.') + 1);
  std::string current;
  std::size_t header = lines.size();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (const std::string found = table_in(lines[i]); !found.empty()) {
      current = found;
      if (current == table) header = i;
    } else if (current == table && leaf_in(lines[i]) == leaf) {
      lines[i] = replaced(lines[i], value);
      return;
    }
  }
  if (header == lines.size()) {
    lines.emplace_back();
    lines.push_back("[" + table + "]");
    header = lines.size() - 1;
  }
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(header) + 1, leaf + " = " + value);
}

std::string edited(std::string_view text, const Values& values) {
  std::vector<std::string> lines = lines_of(text);
  for (const auto& [key, value] : values) set(lines, key, value);
  std::string made;
  for (const std::string& line : lines) made += line + "\n";
  return made;
}

std::string written_anew(std::string_view text, const Values& values) {
  toml::table root = toml::parse(text);
  for (const auto& [key, value] : values) {
    toml::table* table = &root;
    std::size_t begin = 0;
    for (std::size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', begin)) {
      const std::string part = key.substr(begin, dot - begin);
      if (!table->contains(part)) table->insert(part, toml::table{});
      table = (*table)[part].as_table();
      begin = dot + 1;
    }
    const toml::table parsed = toml::parse("value = " + value);
    table->insert_or_assign(key.substr(begin), *parsed.get("value"));
  }
  std::ostringstream out;
  out << root << "\n";
  return out.str();
}

bool is_path(const std::string& key) {
  return key == "map.file" || key == "mission.path_file" || key == "verify.region";
}

/// All values but paths, which are named from elsewhere.
bool same_values(const Scenario& a, const Scenario& b) {
  for (const ScenarioKey& key : scenario_keys()) {
    if (!is_path(key.name) && key.shown(a) != key.shown(b)) return false;
  }
  return true;
}

std::string path_text(const fs::path& path, const fs::path& folder) {
  const fs::path whole = fs::weakly_canonical(fs::absolute(path));
  const fs::path from = fs::weakly_canonical(fs::absolute(folder));
  const fs::path relative = whole.lexically_relative(from);
  return nlohmann::json((relative.empty() ? whole : relative).generic_string()).dump();
}

/// As TOML writes it: what is no TOML value is a string without quotes.
std::string toml_text(const std::string& value) {
  try {
    (void)toml::parse("value = " + value);
    return value;
  } catch (const toml::parse_error&) {
    return nlohmann::json(value).dump();
  }
}

}  // namespace

std::string edited_scenario(std::string_view text, const fs::path& file,
                            std::span<const ScenarioOverride> overrides, const fs::path& folder) {
  const Scenario asked = scenario_of_text(text, file, overrides);
  Values values;
  for (const ScenarioOverride& one : overrides) {
    if (!is_path(one.key)) values.emplace_back(one.key, toml_text(one.value));
  }
  values.emplace_back("map.file", path_text(asked.map.file, folder));
  if (asked.mission.path_file) {
    values.emplace_back("mission.path_file", path_text(*asked.mission.path_file, folder));
  }
  if (!asked.verify.region.file.empty()) {
    values.emplace_back("verify.region", path_text(asked.verify.region.file, folder));
  }
  std::string made = edited(text, values);
  try {
    if (same_values(scenario_of_text(made, folder / "scenario.toml"), asked)) return made;
  } catch (const InputError&) {  // the edit did not suit the form of this text
  }
  made = written_anew(text, values);
  return made;
}

}  // namespace fairway
