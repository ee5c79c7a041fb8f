#include "fairway/map/read_path.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/map/fence_sources.hpp"
#include "fairway/map/frame_from_degrees.hpp"
#include "fairway/map/path_vertex.hpp"

namespace fairway {

namespace {

std::vector<PathVertex> from_mission(const SourceText& source, const ObstacleMap& frame,
                                     const std::vector<MissionPlace>& places) {
  const FrameFromDegrees to_frame(frame, source.file);
  std::vector<PathVertex> vertices;
  for (const MissionPlace& place : places)
    vertices.push_back({place.where, to_frame.point_m(place.where, place.point)});
  return vertices;
}

// The parts of one line: more than one if it was cut at the antimeridian (RFC 7946, 3.1.9).
using Parts = std::vector<JsonPlace>;

bool goes_on_beyond_antimeridian(const JsonPlace& part, const JsonPlace& next) {
  if (part.size() == 0 || next.size() == 0) return false;
  const GeodeticPoint end = part.at(part.size() - 1).longitude_latitude();
  const GeodeticPoint begin = next.at(std::size_t{0}).longitude_latitude();
  return std::abs(end.longitude_deg) == 180.0 && begin.longitude_deg == -end.longitude_deg &&
         std::abs(begin.latitude_deg - end.latitude_deg) < 1e-6;
}

void add_parts(const JsonPlace& parts, bool degrees, std::vector<Parts>& lines) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool goes_on =
        i > 0 && degrees && goes_on_beyond_antimeridian(parts.at(i - 1), parts.at(i));
    if (!goes_on) lines.emplace_back();
    lines.back().push_back(parts.at(i));
  }
}

void find_lines(const JsonPlace& place, bool degrees, std::vector<Parts>& lines) {
  const std::string type = place.at("type").text();
  if (type == "FeatureCollection") {
    const JsonPlace features = place.at("features");
    for (std::size_t i = 0; i < features.size(); ++i) find_lines(features.at(i), degrees, lines);
  } else if (type == "Feature") {
    const JsonPlace geometry = place.at("geometry");
    if (!geometry.value().is_null()) find_lines(geometry, degrees, lines);
  } else if (type == "LineString") {
    lines.push_back({place.at("coordinates")});
  } else if (type == "MultiLineString") {
    add_parts(place.at("coordinates"), degrees, lines);
  }
}

std::vector<PathVertex> from_geojson(const SourceText& source, const nlohmann::json& json,
                                     const ObstacleMap& frame) {
  const bool degrees = has_geographic_frame(frame);
  std::vector<Parts> lines;
  find_lines(JsonPlace(json, source.file.string() + ": "), degrees, lines);
  if (lines.size() != 1)
    throw InputError(source.file.string(),
                     fmt::format("has {} LineStrings, expected one", lines.size()));
  std::vector<PathVertex> vertices;
  std::optional<FrameFromDegrees> to_frame;
  if (degrees) to_frame.emplace(frame, source.file);
  for (const JsonPlace& line : lines.front()) {
    for (std::size_t i = vertices.empty() ? 0 : 1; i < line.size(); ++i) {
      const JsonPlace position = line.at(i);
      if (to_frame) {
        vertices.push_back(
            {position.where(), to_frame->point_m(position.where(), position.longitude_latitude())});
        continue;
      }
      if (position.size() < 2) position.fail("is too short, expected [x_m, y_m]");
      vertices.push_back(
          {position.where(), {position.at(std::size_t{0}).number(), position.at(1).number()}});
    }
  }
  return vertices;
}

std::vector<PathVertex> vertices_of(const std::filesystem::path& file, const ObstacleMap& frame) {
  const SourceText source = read_source(file);
  if (is_waypoint_file(source.text))
    return from_mission(source, frame, read_waypoint_mission(source));
  if (!trimmed(std::string_view(source.text).substr(0, 4096)).starts_with('{'))
    return read_path_csv(source, frame);
  const nlohmann::json json = parse_json(source);
  if (is_qgc_plan(json)) return from_mission(source, frame, read_plan_mission(source, json));
  return from_geojson(source, json, frame);
}

void require_on_map(const std::vector<PathVertex>& vertices, const Grid& grid) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec2 p = vertices[i].point_m;
    if (is_within(grid, p)) continue;
    throw InputError(vertices[i].where, fmt::format("vertex {} {}", i, outside_text(p, grid)));
  }
}

// Degrees mistaken for metres shrink a path to a dot.
void require_extent(const std::vector<Vec2>& vertices, const std::filesystem::path& file,
                    double cell_m) {
  const auto [left, right] = std::minmax_element(vertices.begin(), vertices.end(),
                                                 [](Vec2 a, Vec2 b) { return a.x < b.x; });
  const auto [low, high] = std::minmax_element(vertices.begin(), vertices.end(),
                                               [](Vec2 a, Vec2 b) { return a.y < b.y; });
  const double extent_m = std::max(right->x - left->x, high->y - low->y);
  if (extent_m < cell_m)
    throw InputError(file.string(),
                     fmt::format("the path spans {} m, less than a cell of {} m; are these "
                                 "degrees instead of metres?",
                                 length_text(extent_m), length_text(cell_m)));
}

}  // namespace

std::vector<Vec2> path_vertices(const std::filesystem::path& file, const ObstacleMap& frame) {
  std::vector<Vec2> path;
  for (const PathVertex& vertex : vertices_of(file, frame)) path.push_back(vertex.point_m);
  return path;
}

std::vector<Vec2> read_path(const std::filesystem::path& file, const ObstacleMap& frame,
                            bool closed) {
  const std::vector<PathVertex> vertices = vertices_of(file, frame);
  require_on_map(vertices, frame.grid);
  std::vector<Vec2> path;
  for (const PathVertex& vertex : vertices)
    if (path.empty() || path.back() != vertex.point_m) path.push_back(vertex.point_m);
  if (closed)
    while (path.size() > 1 && path.back() == path.front()) path.pop_back();
  if (path.empty()) throw InputError(file.string(), "has no vertices, expected at least two");
  if (path.size() == 1)
    throw InputError(vertices.back().where,
                     fmt::format("the path has no length: every vertex is {}, "
                                 "expected at least two distinct vertices",
                                 place_text(path.front())));
  require_extent(path, file, frame.grid.cell_m);
  return path;
}

}  // namespace fairway
