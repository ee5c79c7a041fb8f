#include "fairway/run/scenario_text.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/plain_text.hpp"
#include "fairway/run/contract_keys.hpp"
#include "fairway/run/scenario_key_lookup.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/scenario_overrides.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

std::string line_of(const fs::path& file, const toml::source_region& source) {
  return fmt::format("{}:{}", file.string(), source.begin.line);
}

bool is_table_of_keys(const std::string& name) {
  const auto& keys = scenario_keys();
  return std::any_of(keys.begin(), keys.end(), [&](const ScenarioKey& k) {
    return k.table() == name || k.table().starts_with(name + ".");
  });
}

void take_table(const toml::key& toml_key, const toml::node& node, const std::string& name,
                Scenario& scenario);

void take_key(const toml::key& toml_key, const toml::node& node, const std::string& name,
              Scenario& scenario) {
  const TomlSource file{scenario.file.string()};
  const ScenarioKey& key = scenario_key(name, line_of(scenario.file, toml_key.source()));
  key.take(TomlValue(node, file, name, key.range), scenario);
  scenario.lines[name] = static_cast<int>(node.source().begin.line);
}

void take_table(const toml::key& toml_key, const toml::node& node, const std::string& name,
                Scenario& scenario) {
  if (!node.is_table()) {
    throw InputError(line_of(scenario.file, node.source()),
                     fmt::format("{0}: expected a table, [{0}]", name));
  }
  if (name == contract_table && !scenario.contract) scenario.contract.emplace();
  scenario.lines[name] = static_cast<int>(toml_key.source().begin.line);
  for (const auto& [key, value] : *node.as_table()) {
    const std::string inner = name + "." + std::string(key.str());
    (is_table_of_keys(inner) ? take_table : take_key)(key, value, inner, scenario);
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

}  // namespace

Scenario keys_of_text(std::string_view bytes, const fs::path& file,
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
    if (!is_table_of_keys(name)) refuse_unknown_key(name, line_of(file, key.source()));
    take_table(key, node, name, scenario);
  }
  for (const ScenarioOverride& one : overrides) take_override(one, scenario);
  complete_contract(scenario);
  // Flights are exact: they say nothing of a vehicle that only keeps a contract, and under one the
  // paper's wide buffers prove more (docs/tuning.md).
  const bool may_choose = scenario.preset == ParameterPreset::by_map && !scenario.contract;
  scenario.open.alpha = may_choose && !scenario.lines.contains("plan.alpha");
  scenario.open.modes = may_choose && !scenario.contract && !scenario.lines.contains("plan.modes");
  scenario.open.sigma_cells = may_choose && !scenario.lines.contains("plan.sigma_cells");
  return scenario;
}

void use_toml_file(const fs::path& file, const std::function<void(std::string_view)>& use) {
  const MappedFile mapped(file);
  const std::string_view text(reinterpret_cast<const char*>(mapped.bytes().data()),
                              mapped.bytes().size());
  try {
    constexpr std::size_t largest = 1 << 20;
    if (text.size() > largest) {
      throw InputError(file.string(), "is larger than 1 MB, expected a scenario in TOML");
    }
    use(text);
  } catch (const InputError&) {
    refuse_other_kind(mapped.bytes(), FileKind::scenario, file.string());
    throw;
  }
}

}  // namespace fairway
