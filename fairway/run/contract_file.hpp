// A vehicle contract in a file of its own: TOML with a table [vehicle.contract], alone or as part
// of a whole scenario.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "fairway/vehicle/contract.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// The contract of `file` for a plan's vehicle, `nominal`. A range that the file does not name
/// holds the radius or speed of its own [vehicle], and without one the nominal's. Throws
/// InputError{FILE:LINE, KEY ... what is expected}, as read_scenario() does; other tables of the
/// file are read but not checked against each other.
[[nodiscard]] VehicleContract read_contract(const std::filesystem::path& file,
                                            const Vehicle& nominal);

/// The same for text already in memory; `file` names it.
[[nodiscard]] VehicleContract contract_of_text(std::string_view text,
                                               const std::filesystem::path& file,
                                               const Vehicle& nominal);

/// A table [vehicle.contract] with every key, which read_contract() gives back exactly.
[[nodiscard]] std::string contract_toml(const VehicleContract& contract);

/// "keeps a contract: the command of a place within 6 m, give or take 0.035 rad; turns of 18 to 22
/// m; 9 to 11 m/s".
[[nodiscard]] std::string contract_words(const VehicleContract& contract);

}  // namespace fairway
