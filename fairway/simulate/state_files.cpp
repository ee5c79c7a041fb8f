#include "fairway/simulate/state_files.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <optional>

#include "fairway/base/error.hpp"

namespace fairway {

namespace {

constexpr std::array<std::string_view, 3> column_names{"x_m", "y_m", "heading_rad"};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const auto comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// The whole text as a finite number.
std::optional<double> number_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  }
  return "'" + shown + (text.size() > longest ? "...'" : "'");
}

double coordinate(std::string_view text, std::string_view name, const std::string& where) {
  if (const auto value = number_of(text)) return *value;
  throw InputError(
      where, std::string(name) + " is " + quoted(text) + ": expected a finite number of metres");
}

Heading heading(std::string_view text, const std::string& where) {
  const bool degrees = text.ends_with("deg");
  const auto value = number_of(degrees ? trimmed(text.substr(0, text.size() - 3)) : text);
  if (!value) {
    throw InputError(where, "heading_rad is " + quoted(text) +
                                ": expected finite radians, or degrees with the suffix deg");
  }
  // Reduced in degrees, where it is exact: 540deg is the same bits as 180deg.
  return Heading::from_rad(degrees ? std::remainder(*value, 360.0) * (pi / 180.0) : *value);
}

/// Which field is which column, and how many fields a line has.
struct Columns {
  std::array<std::size_t, 3> at{0, 1, 2};
  std::size_t count = 3;
};

Columns columns_of_header(const std::vector<std::string_view>& names, const std::string& where) {
  Columns columns;
  columns.count = names.size();
  for (std::size_t c = 0; c < 3; ++c) {
    std::size_t found = names.size();
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != column_names[c]) continue;
      if (found != names.size()) {
        throw InputError(where, "column " + std::string(column_names[c]) + " appears twice");
      }
      found = i;
    }
    if (found == names.size()) {
      throw InputError(where, "no column " + std::string(column_names[c]) +
                                  " in the header: expected x_m,y_m,heading_rad");
    }
    columns.at[c] = found;
  }
  return columns;
}

State state_of_fields(const std::vector<std::string_view>& fields, const Columns& columns,
                      const std::string& where) {
  if (fields.size() != columns.count) {
    throw InputError(where, std::to_string(fields.size()) + " fields: expected " +
                                std::to_string(columns.count) + " (x_m,y_m,heading_rad)");
  }
  return {{coordinate(fields[columns.at[0]], column_names[0], where),
           coordinate(fields[columns.at[1]], column_names[1], where)},
          heading(fields[columns.at[2]], where)};
}

}  // namespace

std::vector<State> states_of_csv(std::string_view text, const std::string& where) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<State> states;
  Columns columns;
  bool header_possible = true;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    const auto end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line.starts_with('#')) continue;
    const std::string line_where = where + ":" + std::to_string(line_number);
    const auto fields = fields_of(line);
    // A header names at least one of the columns; anything else is taken for numbers gone wrong.
    bool is_header = false;
    for (const auto name : column_names) {
      for (const auto field : fields) is_header = is_header || field == name;
    }
    if (header_possible && is_header) {
      columns = columns_of_header(fields, line_where);
    } else {
      states.push_back(state_of_fields(fields, columns, line_where));
    }
    header_possible = false;
  }
  if (states.empty()) throw InputError(where, "no states: expected lines x_m,y_m,heading_rad");
  return states;
}

std::vector<State> read_states(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw InputError(path.string(), "cannot be read: expected a CSV file x_m,y_m,heading_rad");
  }
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return states_of_csv(text, path.string());
}

State state_of_text(std::string_view text, const std::string& where) {
  return state_of_fields(fields_of(trimmed(text)), Columns{}, where);
}

}  // namespace fairway
