#include "fairway/steer/pose_pairs.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>

#include "fairway/base/error.hpp"
#include "fairway/steer/dubins_words.hpp"

namespace fairway {
namespace {

constexpr std::array<std::string_view, 6> column_names{"x0_m", "y0_m", "h0_rad",
                                                       "x1_m", "y1_m", "h1_rad"};
constexpr const char* expected_columns = "x0_m,y0_m,h0_rad,x1_m,y1_m,h1_rad";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Replaces `fields`: one vector serves every line.
void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const auto comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

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

struct Columns {
  std::array<std::size_t, 6> at{0, 1, 2, 3, 4, 5};
  std::size_t count = 6;
};

/// Where the line is, said only when something is wrong with it.
struct Place {
  const std::string& where;
  std::size_t line;
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(where + ":" + std::to_string(line), what);
  }
};

Columns columns_of_header(const std::vector<std::string_view>& names, const Place& place) {
  Columns columns;
  columns.count = names.size();
  for (std::size_t c = 0; c < column_names.size(); ++c) {
    const std::string name(column_names[c]);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      place.refuse("no column " + name + " in the header: expected " + expected_columns);
    }
    if (std::find(found + 1, names.end(), name) != names.end()) {
      place.refuse("column " + name + " appears twice");
    }
    columns.at[c] = static_cast<std::size_t>(found - names.begin());
  }
  return columns;
}

double value_of(std::string_view text, std::size_t column, const Place& place) {
  const bool is_heading = column % 3 == 2;
  const bool degrees = is_heading && text.ends_with("deg");
  const auto value = number_of(degrees ? trimmed(text.substr(0, text.size() - 3)) : text);
  if (!value) {
    place.refuse(std::string(column_names[column]) + " is " + quoted(text) +
                 (is_heading ? ": expected finite radians, or degrees with the suffix deg"
                             : ": expected a finite number of metres"));
  }
  // Reduced in degrees, where it is exact: 540deg is the same bits as 180deg.
  return degrees ? std::remainder(*value, 360.0) * (pi / 180.0) : *value;
}

}  // namespace

PosePairs pose_pairs_of_csv(std::string_view text, const std::string& where, double turn_radius_m) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  PosePairs pairs;
  Columns columns;
  std::vector<std::string_view> fields;
  bool header_possible = true;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    const auto end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line.starts_with('#')) continue;
    const Place place{where, line_number};
    split(line, fields);
    // A header names at least one of the columns; anything else is taken for numbers gone wrong.
    const bool is_header =
        header_possible && std::find_first_of(fields.begin(), fields.end(), column_names.begin(),
                                              column_names.end()) != fields.end();
    header_possible = false;
    if (is_header) {
      columns = columns_of_header(fields, place);
      continue;
    }
    if (fields.size() != columns.count) {
      place.refuse(std::to_string(fields.size()) + " fields: expected " +
                   std::to_string(columns.count) + " (" + expected_columns + ")");
    }
    std::array<double, 6> v;
    for (std::size_t c = 0; c < 6; ++c) v[c] = value_of(fields[columns.at[c]], c, place);
    const State from{{v[0], v[1]}, Heading::from_rad(v[2])};
    const State to{{v[3], v[4]}, Heading::from_rad(v[5])};
    if (!can_steer(from, to, turn_radius_m)) {
      place.refuse("the poses are more than 1e100 turning radii apart");
    }
    pairs.from.push_back(from);
    pairs.to.push_back(to);
  }
  if (pairs.from.empty()) {
    throw InputError(where, std::string("no pairs: expected lines ") + expected_columns);
  }
  return pairs;
}

}  // namespace fairway
