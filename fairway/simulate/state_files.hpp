// Starts as text: the states CSV of `fairway simulate --states`, `--state X,Y,H`, and
// `--state-deg LAT,LON,COURSE`.
//
// Columns x_m,y_m,heading_rad, as base/number_csv.hpp reads them: others are passed over when there
// is a header, so an outcomes file is a states file. A header may name lat_deg,lon_deg,course_deg
// instead, if the plan is georeferenced.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fairway/base/frame.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Converts a state on Earth to the metres of a plan; throws InputError{where, ...} if there is
/// no such state.
using StateFromEarth = std::function<State(const EarthState& state, const std::string& where)>;

/// Of a file or, for "-", the standard input. Throws InputError{FILE:LINE, ...}, and when the file
/// cannot be read or holds no state, or is in degrees and `from_earth` is empty.
[[nodiscard]] std::vector<State> read_states(const std::filesystem::path& path,
                                             const StateFromEarth& from_earth = {});

/// The same for a text in memory; `where` is used as the file's name in errors.
[[nodiscard]] std::vector<State> states_of_csv(std::string_view text, const std::string& where,
                                               const StateFromEarth& from_earth = {});

/// One state `X,Y,H`. Throws InputError{where, ...}.
[[nodiscard]] State state_of_text(std::string_view text, const std::string& where);

/// One state `LAT,LON,COURSE` in degrees. Throws InputError{where, ...}.
[[nodiscard]] EarthState earth_state_of_text(std::string_view text, const std::string& where);

}  // namespace fairway
