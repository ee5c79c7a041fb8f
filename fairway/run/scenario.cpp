#include "fairway/run/scenario.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/plain_text.hpp"
#include "fairway/run/scenario_key_lookup.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/scenario_overrides.hpp"
#include "fairway/vehicle/size_range.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

std::string line_of(const fs::path& file, const toml::source_region& source) {
  return fmt::format("{}:{}", file.string(), source.begin.line);
}

void take_table(const toml::table& table, const std::string& table_name, Scenario& scenario) {
  const TomlSource file{scenario.file.string()};
  for (const auto& [toml_key, node] : table) {
    const std::string name = table_name + "." + std::string(toml_key.str());
    const ScenarioKey& key = scenario_key(name, line_of(scenario.file, toml_key.source()));
    key.take(TomlValue(node, file, name, key.range), scenario);
    scenario.lines[name] = static_cast<int>(node.source().begin.line);
  }
}

[[noreturn]] void refuse(const Scenario& s, const char* key, const std::string& what) {
  throw InputError(s.place_of(key), fmt::format("{}: {}", key, what));
}

void require_given(const Scenario& s, const char* key, const char* because) {
  if (!s.lines.contains(key)) {
    throw InputError(s.file.string(), fmt::format("{} is missing: {}", key, because));
  }
}

void forbid(const Scenario& s, const char* key, const char* because) {
  if (s.lines.contains(key)) refuse(s, key, because);
}

void check_mission(const Scenario& s) {
  if (s.mission.kind == MissionKind::path) {
    require_given(s, "mission.path_file", "a mission of kind \"path\" needs the path to follow");
    for (const char* key : {"mission.goal_m", "mission.goal_deg", "mission.goal_heading_rad"}) {
      forbid(s, key, "belongs to missions of kind \"goal\", this one is of kind \"path\"");
    }
    return;
  }
  forbid(s, "mission.path_file",
         "belongs to missions of kind \"path\", this one is of kind \"goal\"");
  forbid(s, "mission.closed", "belongs to missions of kind \"path\", this one is of kind \"goal\"");
  if (s.mission.goal_deg && s.mission.goal_m) {
    refuse(s, "mission.goal_deg",
           "is given in addition to mission.goal_m, expected only one of them");
  }
  if (!s.mission.goal_deg) {
    require_given(s, "mission.goal_m",
                  "a mission of kind \"goal\" needs a position, [x, y] in metres");
  }
}

void check(const Scenario& s) {
  for (const ScenarioKey& key : scenario_keys()) {
    if (key.required && !s.lines.contains(key.name)) {
      throw InputError(s.file.string(), fmt::format("{} is missing, expected {} ({})", key.name,
                                                    key.kind, key.meaning));
    }
  }
  if (!size_range::holds(s.map.cell_m)) {
    refuse(s, "map.cell_m", fmt::format("is {} m, expected 1e-15 to 1e15", s.map.cell_m));
  }
  if (!size_range::holds(s.vehicle.speed_mps)) {
    refuse(s, "vehicle.speed_mps",
           fmt::format("is {} m/s, expected 1e-15 to 1e15", s.vehicle.speed_mps));
  }
  if (s.vehicle.turn_radius_m > size_range::most_cells * s.map.cell_m) {
    refuse(s, "vehicle.turn_radius_m",
           fmt::format("is {} m, expected at most 1e9 cells of {} m", s.vehicle.turn_radius_m,
                       s.map.cell_m));
  }
  if (!(s.vehicle.turn_radius_m > s.map.cell_m)) {
    refuse(s, "vehicle.turn_radius_m",
           fmt::format("is {} m, expected more than map.cell_m, which is {} m",
                       s.vehicle.turn_radius_m, s.map.cell_m));
  }
  check_mission(s);
  if (s.verify.border_samples % 4 != 0) {
    refuse(s, "verify.border_samples",
           fmt::format("is {}, expected a multiple of four", s.verify.border_samples));
  }
  if (s.verify.method != VerifyMethod::bitmap) {
    forbid(s, "verify.border_samples", "belongs to verify.method = \"bitmap\"");
  }
}

/// Past a TOML string that begins at `i`; of one that does not end, past its line.
std::size_t past_string(std::string_view text, std::size_t i) {
  const char quote = text[i];
  const bool is_long = text.substr(i, 3) == std::string(3, quote);
  const std::string end(is_long ? 3 : 1, quote);
  for (i += end.size(); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (text.substr(i, end.size()) == end) {
      i += end.size();
      while (is_long && i < text.size() && text[i] == quote) ++i;  // up to two belong to it
      return i;
    } else if (text[i] == '\n' && !is_long) {
      return i;
    }
  }
  return text.size();
}

/// The parser makes a table of every part of a key and takes them down by recursion: a key of tens
/// of thousands of parts would exhaust the stack.
void require_short_keys(std::string_view text, const fs::path& file) {
  constexpr int most_dots = 32;
  int dots = 0;
  int line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const std::size_t next = past_string(text, i);
      line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                          text.begin() + static_cast<std::ptrdiff_t>(next), '\n'));
      i = next;
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    line += c == '\n' ? 1 : 0;
    dots = c == '.' ? dots + 1 : std::string_view("=,[]{}\n").find(c) < 7 ? 0 : dots;
    if (dots > most_dots) {
      throw InputError(fmt::format("{}:{}", file.string(), line),
                       fmt::format("has a key of more than {} parts", most_dots));
    }
    ++i;
  }
}

void root_paths(Scenario& s) {
  const fs::path folder = s.file.parent_path();
  s.map.file = folder / s.map.file;
  if (s.mission.path_file) s.mission.path_file = folder / *s.mission.path_file;
  fs::path& region = s.verify.region.file;
  if (!region.empty()) region = folder / region;
}

}  // namespace

std::string Scenario::place_of(std::string_view key) const {
  if (const auto option = options.find(key); option != options.end()) return option->second;
  const auto line = lines.find(key);
  if (line == lines.end()) return file.string();
  return fmt::format("{}:{}", file.string(), line->second);
}

Scenario scenario_of_text(std::string_view bytes, const fs::path& file,
                          std::span<const ScenarioOverride> overrides) {
  Scenario scenario;
  scenario.file = file;
  scenario.sha256 = sha256_hex(std::as_bytes(std::span(bytes.data(), bytes.size())));
  const std::string text = plain_text(bytes, file.string());
  require_short_keys(text, file);
  toml::table root;
  try {
    root = toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw InputError(line_of(file, error.source()),
                     fmt::format("is not TOML: {}", error.description()));
  }
  for (const auto& [key, node] : root) {
    const std::string name(key.str());
    const auto& keys = scenario_keys();
    if (std::none_of(keys.begin(), keys.end(),
                     [&](const ScenarioKey& k) { return k.table() == name; })) {
      refuse_unknown_key(name, line_of(file, key.source()));
    }
    if (!node.is_table()) {
      throw InputError(line_of(file, node.source()),
                       fmt::format("{0}: expected a table, [{0}]", name));
    }
    take_table(*node.as_table(), name, scenario);
  }
  for (const ScenarioOverride& one : overrides) take_override(one, scenario);
  check(scenario);
  root_paths(scenario);
  return scenario;
}

Scenario read_scenario(const fs::path& file, std::span<const ScenarioOverride> overrides) {
  const MappedFile mapped(file);
  const std::string_view text(reinterpret_cast<const char*>(mapped.bytes().data()),
                              mapped.bytes().size());
  try {
    constexpr std::size_t largest = 1 << 20;
    if (text.size() > largest) {
      throw InputError(file.string(), "is larger than 1 MB, expected a scenario in TOML");
    }
    return scenario_of_text(text, file, overrides);
  } catch (const InputError&) {
    refuse_other_kind(mapped.bytes(), FileKind::scenario, file.string());
    throw;
  }
}

}  // namespace fairway
