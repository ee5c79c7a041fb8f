// Starts as text: the states CSV of `fairway simulate --states`, and `--state X,Y,H`.
//
// Columns x_m,y_m,heading_rad, as base/number_csv.hpp reads them: others are passed over when there
// is a header, so an outcomes file is a states file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Of a file or, for "-", the standard input. Throws InputError{FILE:LINE, ...}, and when the file
/// cannot be read or holds no state.
[[nodiscard]] std::vector<State> read_states(const std::filesystem::path& path);

/// The same for a text in memory; `where` stands for the file's name in errors.
[[nodiscard]] std::vector<State> states_of_csv(std::string_view text, const std::string& where);

/// One state `X,Y,H`. Throws InputError{where, ...}.
[[nodiscard]] State state_of_text(std::string_view text, const std::string& where);

}  // namespace fairway
