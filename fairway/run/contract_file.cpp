#include "fairway/run/contract_file.hpp"

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/run/contract_keys.hpp"
#include "fairway/run/scenario_text.hpp"
#include "fairway/vehicle/contract_defect.hpp"

namespace fairway {

namespace fs = std::filesystem;

VehicleContract contract_of_text(std::string_view text, const fs::path& file,
                                 const Vehicle& nominal) {
  Scenario keys = keys_of_text(text, file);
  if (!keys.contract) {
    throw InputError(file.string(), fmt::format("has no table [{}], expected one: it says what the "
                                                "vehicle keeps (docs/scenario.md)",
                                                contract_table));
  }
  if (!keys.lines.contains("vehicle.turn_radius_m")) {
    keys.vehicle.turn_radius_m = nominal.turn_radius_m;
  }
  if (!keys.lines.contains("vehicle.speed_mps")) keys.vehicle.speed_mps = nominal.speed_mps;
  complete_contract(keys);
  if (const auto defect = contract_defect(*keys.contract, nominal)) {
    const std::string key = fmt::format("{}.{}", contract_table, defect->key);
    throw InputError(keys.place_of(key), key + ": " + defect->what);
  }
  return *keys.contract;
}

VehicleContract read_contract(const fs::path& file, const Vehicle& nominal) {
  VehicleContract contract;
  use_toml_file(file,
                [&](std::string_view text) { contract = contract_of_text(text, file, nominal); });
  return contract;
}

std::string contract_toml(const VehicleContract& contract) {
  Scenario scenario;
  scenario.contract = contract;
  std::string text = fmt::format("[{}]\n", contract_table);
  for (const ScenarioKey& key : contract_keys()) {
    std::string value = key.shown(scenario).dump();  // JSON writes numbers as TOML does
    if (const std::size_t comma = value.find(','); comma < value.size()) {
      value.insert(comma + 1, " ");
    }
    text += fmt::format("{} = {}\n", key.leaf(), value);
  }
  return text;
}

std::string contract_words(const VehicleContract& c) {
  const auto range = [](SizeRange r) {
    return r.least == r.most ? fmt::format("{:g}", r.least)
                             : fmt::format("{:g} to {:g}", r.least, r.most);
  };
  std::string words =
      fmt::format("keeps a contract: the command of a place within {:g} m", c.command_error_m);
  if (c.look_ahead_m > 0.0) words += fmt::format(" of the point {:g} m ahead", c.look_ahead_m);
  words += fmt::format(", give or take {:g} rad; turns of {} m; {} m/s", c.heading_error_rad,
                       range(c.turn_radius_m), range(c.speed_mps));
  if (c.wind_mps > 0.0)
    words += fmt::format(" through air that moves at up to {:g} m/s", c.wind_mps);
  return words;
}

}  // namespace fairway
