#include "fairway/simulate/state_files.hpp"

#include <array>
#include <span>

#include "fairway/base/number_csv.hpp"

namespace fairway {
namespace {

constexpr std::array<CsvColumn, 3> columns{
    {{"x_m"}, {"y_m"}, {"heading_rad", CsvQuantity::heading}}};

State state_of(std::span<const double> v) { return {{v[0], v[1]}, Heading::from_rad(v[2])}; }

}  // namespace

std::vector<State> states_of_csv(std::string_view text, const std::string& where) {
  std::vector<State> states;
  for_csv_lines(text, where, columns, "states",
                [&](std::span<const double> v, const CsvPlace&) { states.push_back(state_of(v)); });
  return states;
}

std::vector<State> read_states(const std::filesystem::path& path) {
  return states_of_csv(csv_text(path.string(), columns), csv_name(path.string()));
}

State state_of_text(std::string_view text, const std::string& where) {
  return state_of(csv_values(text, where, columns));
}

}  // namespace fairway
