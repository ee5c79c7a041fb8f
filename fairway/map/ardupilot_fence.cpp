// ArduPilot fence text: "latitude longitude" per line, first the return point, then a ring whose
// last line repeats its first. Lines that start with '#' are comments.

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/map/fence_sources.hpp"

namespace fairway {

namespace {

struct FencePoint {
  GeodeticPoint point;
  std::size_t line;
};

std::vector<FencePoint> read_points(const SourceText& source) {
  std::vector<FencePoint> points;
  for (const Line& line : lines_of(source.text)) {
    const std::string_view text = trimmed(line.text);
    if (text.empty() || text.starts_with('#')) continue;
    const std::string where = at_line(source.file, line.number);
    const auto words = split(text, text.find(',') == text.npos ? ' ' : ',');
    if (words.size() != 2)
      throw InputError(where, fmt::format("{} has {} values, expected latitude and longitude",
                                          shown(text), words.size()));
    double values[2];
    for (std::size_t i = 0; i < 2; ++i) {
      const auto number = parse_number(words[i]);
      if (!number) throw InputError(where, fmt::format("{} is not a number", shown(words[i])));
      values[i] = *number;
    }
    const GeodeticPoint point{values[0], values[1]};
    require_geodetic(where, point);
    points.push_back({point, line.number});
  }
  return points;
}

}  // namespace

GeodeticFences read_ardupilot_fence(const SourceText& source) {
  const std::vector<FencePoint> points = read_points(source);
  if (points.size() < 5)
    throw InputError(source.file.string(),
                     fmt::format("has {} points, expected a return point and a closed ring with at "
                                 "least 3 corners (5 lines)",
                                 points.size()));
  if (points.back().point != points[1].point)
    throw InputError(at_line(source.file, points.back().line),
                     fmt::format("the ring is not closed: the last point differs from the first "
                                 "corner in line {}",
                                 points[1].line));
  GeodeticFences fences;
  fences.inputs.push_back(source.input);
  fences.home = points.front().point;
  GeodeticPolygon polygon{true, source.file.string(), {}};
  GeodeticRing& ring = polygon.rings.emplace_back();
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    ring.points.push_back(points[i].point);
    ring.lines.push_back(points[i].line);
  }
  fences.polygons.push_back(std::move(polygon));
  return fences;
}

}  // namespace fairway
