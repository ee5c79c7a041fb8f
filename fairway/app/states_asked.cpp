#include "fairway/app/states_asked.hpp"

#include <optional>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/map/earth_frame.hpp"
#include "fairway/simulate/state_files.hpp"

namespace fairway {

void declare_states(CLI::App& options, StatesAsked& asked, const std::string& noun) {
  options
      .add_option("--state", asked.metres,
                  fmt::format("a {}: metres, and heading in radians, or degrees with the suffix "
                              "deg; may be repeated",
                              noun))
      ->type_name("X,Y,H")
      ->check(state_argument())
      ->allow_extra_args(false)
      ->delimiter('\0');
  options
      .add_option("--state-deg", asked.degrees,
                  fmt::format("a {} on a georeferenced map: degrees, with the course clockwise "
                              "from north; may be repeated",
                              noun))
      ->type_name("LAT,LON,COURSE")
      ->check(earth_state_argument())
      ->allow_extra_args(false)
      ->delimiter('\0');
  options
      .add_option("--states", asked.file,
                  fmt::format("read {}s from a CSV file with x_m,y_m,heading_rad or lat_deg,"
                              "lon_deg,course_deg; - for standard input",
                              noun))
      ->type_name("CSV");
}

std::vector<State> states_of(const StatesAsked& asked, const Frame& frame,
                             const std::filesystem::path& file) {
  std::vector<State> states;
  for (const std::string& text : asked.metres) states.push_back(state_of_argument(text));
  std::optional<EarthFrame> earth;
  if (!asked.degrees.empty() || frame.is_on_earth()) earth.emplace(frame, file.string());
  for (const std::string& text : asked.degrees)
    states.push_back(earth->state_of(earth_state_of_argument(text), "--state-deg " + text));
  if (asked.file.empty()) return states;
  StateFromEarth from_earth;
  if (earth) {
    from_earth = [&](const EarthState& state, const std::string& where) {
      return earth->state_of(state, where);
    };
  }
  for (const State& s : read_states(asked.file, from_earth)) states.push_back(s);
  return states;
}

}  // namespace fairway
