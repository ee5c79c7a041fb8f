#include "fairway/base/number_csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/plain_text.hpp"

namespace fairway {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

char separator_of(std::string_view line) {
  for (const char c : {';', ',', '\t'}) {
    if (line.find(c) != std::string_view::npos) return c;
  }
  return ',';
}

/// Replaces `fields`: one vector serves every line.
void split(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const auto end = line.find(separator);
    fields.push_back(csv_field(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
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

std::string names_of(std::span<const CsvColumn> columns) {
  std::string names;
  for (const CsvColumn& column : columns) {
    if (!names.empty()) names += ',';
    names += column.name;
  }
  return names;
}

double degrees_of(std::string_view text, const CsvColumn& column, const CsvPlace& place) {
  const double most = column.quantity == CsvQuantity::latitude    ? 90.0
                      : column.quantity == CsvQuantity::longitude ? 180.0
                                                                  : 360.0;
  const auto value = number_of(text);
  if (value && std::abs(*value) <= most) return *value;
  const std::string range = std::to_string(static_cast<int>(most));
  place.refuse(std::string(column.name) + " is " + quoted(text) + ": expected degrees from -" +
               range + " to " + range +
               (column.quantity == CsvQuantity::course ? ", clockwise from north" : ""));
}

double value_of(std::string_view text, const CsvColumn& column, const CsvPlace& place) {
  const bool is_heading = column.quantity == CsvQuantity::heading;
  const bool is_plain =
      column.quantity == CsvQuantity::metres || column.quantity == CsvQuantity::seconds;
  if (!is_heading && !is_plain) {
    return degrees_of(text, column, place);
  }
  const bool degrees = is_heading && text.ends_with("deg");
  const auto value = number_of(degrees ? trimmed(text.substr(0, text.size() - 3)) : text);
  if (!value) {
    place.refuse(std::string(column.name) + " is " + quoted(text) +
                 (is_heading ? ": expected finite radians, or degrees with the suffix deg"
                  : column.quantity == CsvQuantity::seconds
                      ? ": expected a finite number of seconds"
                      : ": expected a finite number of metres"));
  }
  if (!is_heading) return *value;
  if (!degrees && std::abs(*value) > most_heading_rad) {
    const bool may_be_degrees = std::abs(*value) <= 360.0;
    place.refuse(std::string(column.name) + " is " + quoted(text) +
                 ": expected radians from -7 to 7, or degrees with the suffix deg" +
                 (may_be_degrees ? "; did you mean " + std::string(text) + "deg?" : ""));
  }
  // Reduced in degrees, where this is exact: 540deg gives the same bits as 180deg.
  return Heading::from_rad(degrees ? std::remainder(*value, 360.0) * (pi / 180.0) : *value).rad();
}

/// Which field is which column, and how many fields a line has.
struct Fields {
  std::vector<std::size_t> at;
  std::size_t count = 0;
};

Fields fields_without_header(std::size_t count) {
  Fields fields{{}, count};
  for (std::size_t c = 0; c < count; ++c) fields.at.push_back(c);
  return fields;
}

Fields fields_of_header(const std::vector<std::string_view>& names,
                        std::span<const CsvColumn> columns, const CsvPlace& place) {
  Fields fields{{}, names.size()};
  for (const CsvColumn& column : columns) {
    const std::string name(column.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      place.refuse("no column " + name + " in the header: expected " + names_of(columns));
    }
    if (std::find(found + 1, names.end(), name) != names.end()) {
      place.refuse("column " + name + " appears twice");
    }
    fields.at.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  return fields;
}

void read_values(const std::vector<std::string_view>& words, const Fields& fields,
                 std::span<const CsvColumn> columns, const CsvPlace& place,
                 std::vector<double>& values) {
  if (words.size() != fields.count) {
    place.refuse(std::to_string(words.size()) + " fields: expected " +
                 std::to_string(fields.count) + " (" + names_of(columns) + ")");
  }
  values.clear();
  for (std::size_t c = 0; c < columns.size(); ++c) {
    values.push_back(value_of(words[fields.at[c]], columns[c], place));
  }
}

}  // namespace

void CsvPlace::refuse(const std::string& what) const {
  throw InputError(line == 0 ? where : where + ":" + std::to_string(line), what);
}

void for_csv_lines(std::string_view text, const std::string& where,
                   std::span<const CsvColumn> columns, const char* lines, const CsvTake& take) {
  const std::string plain = plain_text(text, where);
  text = plain;
  char separator = 0;  // that of the first line that is not a comment
  Fields fields = fields_without_header(columns.size());
  std::vector<std::string_view> words;
  std::vector<double> values;
  bool header_possible = true;
  bool any = false;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    const auto end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line.starts_with('#')) continue;
    const CsvPlace place{where, line_number};
    if (separator == 0) separator = separator_of(line);
    split(line, separator, words);
    // A header names at least one of the columns; anything else is read as malformed numbers.
    const bool is_header =
        header_possible && std::any_of(columns.begin(), columns.end(), [&](const CsvColumn& c) {
          return std::find(words.begin(), words.end(), c.name) != words.end();
        });
    header_possible = false;
    if (is_header) {
      fields = fields_of_header(words, columns, place);
      continue;
    }
    read_values(words, fields, columns, place, values);
    take(values, place);
    any = true;
  }
  if (!any) {
    throw InputError(where, "no " + std::string(lines) + ": expected lines " + names_of(columns));
  }
}

bool csv_header_names(std::string_view text, const std::string& where, std::string_view name) {
  const std::string plain = plain_text(text, where);
  text = plain;
  while (!text.empty()) {
    const auto end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line.starts_with('#')) continue;
    std::vector<std::string_view> words;
    split(line, separator_of(line), words);
    return std::find(words.begin(), words.end(), name) != words.end();
  }
  return false;
}

std::vector<double> csv_values(std::string_view line, const std::string& where,
                               std::span<const CsvColumn> columns) {
  std::vector<std::string_view> words;
  line = trimmed(line);
  split(line, separator_of(line), words);
  std::vector<double> values;
  read_values(words, fields_without_header(columns.size()), columns, {where, 0}, values);
  return values;
}

std::string csv_text(const std::string& file, std::span<const CsvColumn> columns) {
  if (file == "-") return {std::istreambuf_iterator<char>(std::cin), {}};
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    throw InputError(file, "cannot be read: expected a CSV file " + names_of(columns));
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string csv_name(const std::string& file) { return file == "-" ? "standard input" : file; }

}  // namespace fairway
