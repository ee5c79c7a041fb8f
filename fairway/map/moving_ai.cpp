// MovingAI .map: "type octile", "height H", "width W", "map", then H rows of W characters, the
// upper row first. '.', 'G' and 'S' can be crossed; everything else (@ O T W ...) is an obstacle.

#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/map/image_rows.hpp"
#include "fairway/map/map_sources.hpp"

namespace fairway {

namespace {

struct Header {
  int width = 0;
  int height = 0;
  std::size_t rows_begin = 0;  // index into the lines
};

int read_size(const SourceText& source, const Line& line, std::string_view value, int previous) {
  const std::string where = at_line(source.file, line.number);
  if (previous != 0) throw InputError(where, "the size occurs twice");
  const auto number = parse_number(value);
  constexpr int largest = 1'000'000'000;
  if (!number || !(*number >= 1.0 && *number <= largest) || *number != std::floor(*number))
    throw InputError(where, fmt::format("{} is not a size, expected a whole number from 1 to {}",
                                        shown(value), largest));
  return static_cast<int>(*number);
}

Header read_header(const SourceText& source, const std::vector<Line>& lines) {
  Header header;
  bool typed = false;
  for (std::size_t i = 0; i < lines.size() && i < 16; ++i) {
    const auto words = split(lines[i].text, ' ');
    const std::string where = at_line(source.file, lines[i].number);
    if (words.empty()) continue;
    if (words[0] == "map" && words.size() == 1) {
      header.rows_begin = i + 1;
      if (!typed) throw InputError(where, "the line \"type octile\" is missing before \"map\"");
      if (header.height == 0) throw InputError(where, "the line \"height N\" is missing");
      if (header.width == 0) throw InputError(where, "the line \"width N\" is missing");
      return header;
    }
    if (words.size() != 2)
      throw InputError(where, fmt::format("unexpected {}; a MovingAI map starts with "
                                          "type, height, width and map",
                                          shown(lines[i].text)));
    if (words[0] == "type") {
      if (words[1] != "octile")
        throw InputError(where,
                         fmt::format("type {} is unknown, expected octile", shown(words[1])));
      typed = true;
    } else if (words[0] == "height") {
      header.height = read_size(source, lines[i], words[1], header.height);
    } else if (words[0] == "width") {
      header.width = read_size(source, lines[i], words[1], header.width);
    } else {
      throw InputError(where, fmt::format("{} is unknown, expected type, height, width or map",
                                          shown(words[0])));
    }
  }
  throw InputError(source.file.string(), "the line \"map\" is missing: not a MovingAI map");
}

void read_row(const SourceText& source, const Line& line, SourceRaster& raster, int row) {
  Pixel* out = raster.row(row);
  for (std::size_t i = 0; i < line.text.size(); ++i) {
    const char c = line.text[i];
    if (c <= ' ' || c > '~')
      throw InputError(at_line(source.file, line.number),
                       fmt::format("column {} holds byte {}, expected a printable character", i + 1,
                                   static_cast<int>(static_cast<unsigned char>(c))));
    out[i] = c == '.' || c == 'G' || c == 'S' ? Pixel::free : Pixel::obstacle;
  }
}

}  // namespace

SourceRaster read_moving_ai(const SourceText& source, const MapRequest& request) {
  const std::vector<Line> lines = lines_of(source.text);
  const Header header = read_header(source, lines);
  require_image_size(source.file, header.width, header.height, request.max_pixels);
  const double resolution_m = required_resolution_m(request);
  std::size_t rows_end = lines.size();
  while (rows_end > header.rows_begin && trimmed(lines[rows_end - 1].text).empty()) --rows_end;
  const std::size_t rows = rows_end - header.rows_begin;
  if (rows != static_cast<std::size_t>(header.height))
    throw InputError(at_line(source.file, rows_end),
                     fmt::format("the map has {} rows, expected {} (height)", rows, header.height));
  for (std::size_t i = header.rows_begin; i < rows_end; ++i)
    if (lines[i].text.size() != static_cast<std::size_t>(header.width))
      throw InputError(at_line(source.file, lines[i].number),
                       fmt::format("the row has {} characters, expected {} (width)",
                                   lines[i].text.size(), header.width));
  SourceRaster raster;
  raster.width = header.width;
  raster.height = header.height;
  raster.pixel_width_m = raster.pixel_height_m = resolution_m;
  raster.pixels.resize(static_cast<std::size_t>(header.width) *
                       static_cast<std::size_t>(header.height));
  for (int row = 0; row < header.height; ++row)
    read_row(source, lines[header.rows_begin + static_cast<std::size_t>(row)], raster, row);
  raster.inputs.push_back(source.input);
  return raster;
}

}  // namespace fairway
