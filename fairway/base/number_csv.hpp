// CSV files of places and headings, read strictly: states, pairs of poses, waypoints.
//
// With a header, columns are found by name and others are ignored; without one, a line has exactly
// the columns requested. Commas, semicolons or tabs separate; names and numbers may be quoted.
// Blank lines and lines that start with # are skipped. A heading is in radians from -7 to 7, or in
// degrees with the suffix deg, and is returned wrapped into (-pi, pi]. Every number is finite.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fairway {

/// A larger value in radians cannot be intended: it is refused wherever states are given.
inline constexpr double most_heading_rad = 7.0;

/// Angles of a place on Earth and a course, degrees clockwise from north, are in degrees: latitudes
/// from -90 to 90, longitudes from -180 to 180, courses from -360 to 360.
enum class CsvQuantity : std::uint8_t { metres, seconds, heading, latitude, longitude, course };

struct CsvColumn {
  std::string_view name;
  CsvQuantity quantity = CsvQuantity::metres;
};

/// Where a line is; formatted only when something is wrong with it.
struct CsvPlace {
  const std::string& where;
  std::size_t line = 0;  ///< from 1; 0: not a line of a file
  /// Throws InputError{where:line, what}.
  [[noreturn]] void refuse(const std::string& what) const;
};

/// One value per column, in the order of the columns.
using CsvTake = std::function<void(std::span<const double> values, const CsvPlace& place)>;

/// Calls take for every line of numbers. Throws InputError{where:LINE, ...} for any other line, and
/// InputError{where, ...} when there are no lines: "no states: expected lines x_m,...", where
/// `lines` says what they are.
void for_csv_lines(std::string_view text, const std::string& where,
                   std::span<const CsvColumn> columns, const char* lines, const CsvTake& take);

/// True when the text has a header, and `name` is one of its columns. Throws InputError{where, ...}
/// for what is no text.
[[nodiscard]] bool csv_header_names(std::string_view text, const std::string& where,
                                    std::string_view name);

/// The values of one line without a header. Throws InputError{where, ...}.
[[nodiscard]] std::vector<double> csv_values(std::string_view line, const std::string& where,
                                             std::span<const CsvColumn> columns);

/// The text of a file, or of standard input for "-". Throws InputError when it cannot be read.
[[nodiscard]] std::string csv_text(const std::string& file, std::span<const CsvColumn> columns);

/// Its name in messages: the file's name, or "standard input".
[[nodiscard]] std::string csv_name(const std::string& file);

}  // namespace fairway
