#include "fairway/identify/read_flight_log.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_csv.hpp"
#include "fairway/base/plain_text.hpp"
#include "fairway/identify/log_troubles.hpp"

namespace fairway {
namespace {

using Names = std::array<std::string, 5>;

const Names east_names{"t_s", "x_m", "y_m", "course_rad", "command_rad"};
const Names north_names{"t_s", "x_east_m", "y_north_m", "course_rad", "command_rad"};

/// The fields of the first line that is neither blank nor a comment.
std::vector<std::string> header_of(std::string_view text) {
  std::vector<std::string> names;
  while (!text.empty()) {
    const auto end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (csv_field(line).empty() || csv_field(line).starts_with('#')) continue;
    while (true) {
      const auto comma = line.find_first_of(",;\t");
      names.emplace_back(csv_field(line.substr(0, comma)));
      if (comma == std::string_view::npos) return names;
      line.remove_prefix(comma + 1);
    }
  }
  return names;
}

bool has_all(const std::vector<std::string>& header, const Names& names) {
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return std::find(header.begin(), header.end(), name) != header.end();
  });
}

struct Reading {
  Names names;
  LogAngles angles = LogAngles::east_ccw_rad;
};

Reading reading_of(const std::vector<std::string>& header, const LogFormat& format,
                   const std::string& where) {
  if (header.empty()) throw InputError(where, "is empty: expected a flight log with a header");
  Reading reading{east_names};
  if (!format.columns.empty()) {
    std::copy_n(format.columns.begin(), reading.names.size(), reading.names.begin());
  } else if (!has_all(header, east_names) && has_all(header, north_names)) {
    reading = {north_names, LogAngles::north_cw_rad};
  }
  if (format.angles != LogAngles::by_names) reading.angles = format.angles;
  for (const std::string& name : reading.names) {
    if (std::find(header.begin(), header.end(), name) != header.end()) continue;
    throw InputError(where,
                     fmt::format("no column {} among {}: expected {}; name others with "
                                 "--columns time=...,x=...,y=...,course=...,command=...",
                                 name, fmt::join(header, ","), fmt::join(reading.names, ",")));
  }
  return reading;
}

Heading heading_of(double value, const std::string& name, LogAngles angles, const CsvPlace& place) {
  if (angles != LogAngles::north_cw_deg && std::abs(value) > most_heading_rad) {
    place.refuse(
        fmt::format("{} is {:g}: expected radians from -7 to 7; for degrees clockwise from "
                    "north give --angles compass-deg",
                    name, value));
  }
  switch (angles) {
    case LogAngles::north_cw_rad:
      return Heading::from_rad(0.5 * pi - value);
    case LogAngles::north_cw_deg:
      return Heading::from_rad((90.0 - value) * (pi / 180.0));
    default:
      return Heading::from_rad(value);
  }
}

}  // namespace

std::vector<std::string> log_columns_of(const std::string& text, const std::string& where) {
  static constexpr std::array<std::string_view, 5> parts{"time", "x", "y", "course", "command"};
  std::vector<std::string> names(east_names.begin(), east_names.end());
  std::string_view rest = text;
  while (!rest.empty()) {
    const auto comma = rest.find(',');
    const std::string_view word = rest.substr(0, comma);
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    const auto equals = word.find('=');
    const auto part = std::find(parts.begin(), parts.end(), word.substr(0, equals));
    if (equals == std::string_view::npos || part == parts.end() || equals + 1 == word.size()) {
      throw InputError(where, fmt::format("'{}': expected PART=NAME with a part of {}", word,
                                          fmt::join(parts, ", ")));
    }
    names[static_cast<std::size_t>(part - parts.begin())] = word.substr(equals + 1);
  }
  return names;
}

FlightLog read_flight_log(const std::string& file, const LogFormat& format) {
  const std::string where = csv_name(file);
  constexpr std::array<CsvColumn, 5> known{
      {{"t_s"}, {"x_m"}, {"y_m"}, {"course_rad"}, {"command_rad"}}};
  const std::string text = plain_text(csv_text(file, known), where);
  const Reading reading = reading_of(header_of(text), format, where);
  const auto angle =
      reading.angles == LogAngles::north_cw_deg ? CsvQuantity::course : CsvQuantity::metres;
  const auto& names = reading.names;
  const std::array<CsvColumn, 5> columns{{{names[0], CsvQuantity::seconds},
                                          {names[1]},
                                          {names[2]},
                                          {names[3], angle},
                                          {names[4], angle}}};
  FlightLog log{where, {}};
  for_csv_lines(text, where, columns, "samples",
                [&](std::span<const double> v, const CsvPlace& place) {
                  log.samples.push_back({v[0],
                                         {v[1], v[2]},
                                         heading_of(v[3], names[3], reading.angles, place),
                                         heading_of(v[4], names[4], reading.angles, place),
                                         place.line});
                });
  require_sound(log);
  return log;
}

}  // namespace fairway
