#include "fairway/simulate/state_files.hpp"

#include <array>
#include <span>

#include "fairway/base/error.hpp"
#include "fairway/base/number_csv.hpp"

namespace fairway {
namespace {

constexpr std::array<CsvColumn, 3> columns{
    {{"x_m"}, {"y_m"}, {"heading_rad", CsvQuantity::heading}}};

constexpr std::array<CsvColumn, 3> earth_columns{{{"lat_deg", CsvQuantity::latitude},
                                                  {"lon_deg", CsvQuantity::longitude},
                                                  {"course_deg", CsvQuantity::course}}};

State state_of(std::span<const double> v) { return {{v[0], v[1]}, Heading::from_rad(v[2])}; }
EarthState earth_state_of(std::span<const double> v) { return {v[0], v[1], v[2]}; }

}  // namespace

std::vector<State> states_of_csv(std::string_view text, const std::string& where,
                                 const StateFromEarth& from_earth) {
  std::vector<State> states;
  if (csv_header_names(text, where, "lat_deg") && !csv_header_names(text, where, "x_m")) {
    if (!from_earth) {
      throw InputError(where,
                       "is in degrees, and the map is not georeferenced; expected columns "
                       "x_m,y_m,heading_rad");
    }
    for_csv_lines(text, where, earth_columns, "states",
                  [&](std::span<const double> v, const CsvPlace& place) {
                    const std::string line = place.where + ":" + std::to_string(place.line);
                    states.push_back(from_earth(earth_state_of(v), line));
                  });
    return states;
  }
  for_csv_lines(text, where, columns, "states",
                [&](std::span<const double> v, const CsvPlace&) { states.push_back(state_of(v)); });
  return states;
}

std::vector<State> read_states(const std::filesystem::path& path,
                               const StateFromEarth& from_earth) {
  return states_of_csv(csv_text(path.string(), columns), csv_name(path.string()), from_earth);
}

State state_of_text(std::string_view text, const std::string& where) {
  return state_of(csv_values(text, where, columns));
}

EarthState earth_state_of_text(std::string_view text, const std::string& where) {
  return earth_state_of(csv_values(text, where, earth_columns));
}

}  // namespace fairway
