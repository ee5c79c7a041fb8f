#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/plain_text.hpp"
#include "fairway/map/frame_from_degrees.hpp"
#include "fairway/map/path_vertex.hpp"

namespace fairway {

namespace {

struct Columns {
  std::size_t first = 0;   // x, or latitude
  std::size_t second = 1;  // y, or longitude
  bool degrees = false;
};

char separator_of(std::string_view line) {
  for (const char c : {';', ','})
    if (line.find(c) != line.npos) return c;
  return ' ';
}

std::string column_name(std::string_view word) { return lower(csv_field(word)); }

std::optional<std::size_t> find_column(const std::vector<std::string>& names,
                                       std::initializer_list<const char*> wanted) {
  for (const char* name : wanted) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  }
  return std::nullopt;
}

std::optional<Columns> columns_of(std::string_view header) {
  std::vector<std::string> names;
  for (const auto word : split(header, separator_of(header))) names.push_back(column_name(word));
  const auto x = find_column(names, {"x_m", "x"});
  const auto y = find_column(names, {"y_m", "y"});
  if (x && y) return Columns{*x, *y, false};
  const auto latitude = find_column(names, {"latitude_deg", "lat_deg", "latitude", "lat"});
  const auto longitude =
      find_column(names, {"longitude_deg", "lon_deg", "longitude", "lon", "lng", "long"});
  if (latitude && longitude) return Columns{*latitude, *longitude, true};
  return std::nullopt;
}

struct Row {
  std::string where;
  std::array<double, 2> values;
};

class CsvReader {
 public:
  explicit CsvReader(const SourceText& source) : source_(source) {
    for (const Line& line : lines_of(source.text)) take(line);
  }

  std::vector<Row> rows;
  Columns columns;

 private:
  void take(const Line& line) {
    std::string_view text = trimmed(line.text);
    if (text.empty()) return;
    if (text.starts_with('#')) {  // may be the header; other comments do not name columns
      if (!rows.empty()) return;
      while (text.starts_with('#')) text.remove_prefix(1);
      if (const auto found = columns_of(trimmed(text))) columns = *found;
      return;
    }
    const std::string where = at_line(source_.file, line.number);
    if (rows.empty() && !had_header_ && is_header(text)) {
      had_header_ = true;
      const auto found = columns_of(text);
      if (!found)
        throw InputError(where,
                         fmt::format("the header {} has no columns x_m and y_m", shown(text)));
      columns = *found;
      return;
    }
    rows.push_back({where, values_of(where, text)});
  }

  static bool is_header(std::string_view text) {
    const auto words = split(text, separator_of(text));
    return !words.empty() && !csv_field(words.front()).empty() &&
           !parse_number(csv_field(words.front()));
  }

  std::array<double, 2> values_of(const std::string& where, std::string_view text) {
    if (rows.empty()) separator_ = separator_of(text);
    const auto words = split(text, separator_);
    const std::size_t needed = std::max(columns.first, columns.second) + 1;
    if (rows.empty()) width_ = words.size();
    if (words.size() < needed || words.size() != width_)
      throw InputError(where, fmt::format("has {} columns, expected {}", words.size(),
                                          std::max(needed, width_)));
    std::array<double, 2> values{};
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string_view word = csv_field(words[i == 0 ? columns.first : columns.second]);
      const auto number = parse_number(word);
      if (!number) throw InputError(where, fmt::format("{} is not a number", shown(word)));
      if (!std::isfinite(*number))
        throw InputError(where, fmt::format("{} is not finite", shown(word)));
      values[i] = *number;
    }
    return values;
  }

  const SourceText& source_;
  char separator_ = ',';
  std::size_t width_ = 0;
  bool had_header_ = false;
};

}  // namespace

std::vector<PathVertex> read_path_csv(const SourceText& source, const ObstacleMap& frame) {
  const CsvReader csv(source);
  std::vector<PathVertex> vertices;
  if (csv.columns.degrees) {
    const FrameFromDegrees to_frame(frame, source.file);
    for (const Row& row : csv.rows)
      vertices.push_back({row.where, to_frame.point_m(row.where, {row.values[0], row.values[1]})});
  } else {
    for (const Row& row : csv.rows) vertices.push_back({row.where, {row.values[0], row.values[1]}});
  }
  return vertices;
}

}  // namespace fairway
