#include "fairway/map/read_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_csv.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/map/cells_in_polygon.hpp"
#include "fairway/map/frame_from_degrees.hpp"
#include "fairway/map/geodetic_fences.hpp"
#include "fairway/map/json_source.hpp"
#include "fairway/map/simple_polygon.hpp"
#include "fairway/map/source_text.hpp"

namespace fairway {
namespace {

/// The `coordinates` of every polygon of a GeoJSON text: lists of rings.
void find_polygons(const JsonPlace& place, std::vector<JsonPlace>& polygons) {
  const std::string type = place.at("type").text();
  if (type == "FeatureCollection") {
    const JsonPlace features = place.at("features");
    for (std::size_t i = 0; i < features.size(); ++i) find_polygons(features.at(i), polygons);
  } else if (type == "Feature") {
    const JsonPlace geometry = place.at("geometry");
    if (!geometry.value().is_null()) find_polygons(geometry, polygons);
  } else if (type == "Polygon") {
    polygons.push_back(place.at("coordinates"));
  } else if (type == "MultiPolygon") {
    const JsonPlace parts = place.at("coordinates");
    for (std::size_t i = 0; i < parts.size(); ++i) polygons.push_back(parts.at(i));
  } else {
    place.at("type").fail(
        fmt::format("is {}, expected areas: Polygon or MultiPolygon", shown(type)));
  }
}

/// A position's two numbers, as they stand.
Vec2 position_of(const JsonPlace& position) {
  if (position.size() < 2) position.fail("is too short, expected two numbers");
  return {position.at(std::size_t{0}).number(), position.at(1).number()};
}

/// Without the repeated last position, which must be there, and without neighbours that are equal.
std::vector<Vec2> ring_of(const JsonPlace& positions) {
  std::vector<Vec2> ring;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec2 p = position_of(positions.at(i));
    if (ring.empty() || ring.back() != p) ring.push_back(p);
  }
  if (positions.size() < 4 || ring.front() != position_of(positions.at(positions.size() - 1))) {
    positions.fail("expected a closed ring: at least 4 positions, the last equal to the first");
  }
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  if (ring.size() < 3) positions.fail("expected a ring of at least 3 different positions");
  return ring;
}

using Rings = std::vector<std::vector<Vec2>>;

void require_simple(const Rings& rings, const JsonPlace& place) {
  if (const auto contact = find_contact(rings)) {
    place.fail(fmt::format("crosses or touches itself near ({:.7g}, {:.7g})", contact->at.x,
                           contact->at.y));
  }
}

/// Areas in degrees on a tangent plane: edges are straight in degrees, as those of maps are.
FencePolygon in_plane(const Rings& degrees, const std::string& where, const GeoReference& geo) {
  GeodeticPolygon polygon{false, where, {}};
  for (const auto& ring : degrees) {
    GeodeticRing& out = polygon.rings.emplace_back();
    for (const Vec2 p : ring) out.points.push_back({p.y, p.x});
  }
  GeodeticFences fences;
  fences.polygons.push_back(std::move(polygon));
  return in_tangent_plane(fences, GeodeticPoint{geo.latitude_deg, geo.longitude_deg})
      .keep_out.front();
}

std::vector<std::uint8_t> cells_of_geojson(const SourceText& source, const Grid& grid,
                                           const Frame& frame) {
  const nlohmann::json json = parse_json(source);
  std::vector<JsonPlace> polygons;
  find_polygons(JsonPlace(json, source.file.string() + ": "), polygons);
  std::optional<FrameFromDegrees> projected;
  if (frame.projected_crs) {
    ObstacleMap map;
    map.grid = grid;
    map.frame = frame;
    projected.emplace(map, source.file);
  }
  std::vector<std::uint8_t> cells(grid.size());
  for (const JsonPlace& polygon : polygons) {
    Rings rings;
    for (std::size_t r = 0; r < polygon.size(); ++r) rings.push_back(ring_of(polygon.at(r)));
    if (rings.empty()) polygon.fail("has no ring");
    require_simple(rings, polygon);
    if (frame.geo) {
      mark_cells_in(in_plane(rings, polygon.where(), *frame.geo), grid, cells);
      continue;
    }
    for (std::size_t r = 0; projected && r < rings.size(); ++r) {
      for (Vec2& p : rings[r]) p = projected->point_m(polygon.where(), {p.y, p.x});
    }
    mark_cells_in({std::move(rings)}, grid, cells);
  }
  return cells;
}

std::vector<std::uint8_t> cells_of_csv(const SourceText& source, const Grid& grid) {
  constexpr std::array<CsvColumn, 2> columns{{{"ix"}, {"iy"}}};
  std::vector<std::uint8_t> cells(grid.size());
  for_csv_lines(
      source.text, source.file.string(), columns, "cells",
      [&](std::span<const double> value, const CsvPlace& place) {
        const auto holds = [](double i, int n) { return i >= 0.0 && i < n && i == std::floor(i); };
        if (!holds(value[0], grid.nx) || !holds(value[1], grid.ny)) {
          place.refuse(
              fmt::format("is no cell of the grid: expected whole numbers, ix 0 to {} and "
                          "iy 0 to {}",
                          grid.nx - 1, grid.ny - 1));
        }
        cells[grid.index({static_cast<int>(value[0]), static_cast<int>(value[1])})] = 1;
      });
  return cells;
}

}  // namespace

std::vector<std::uint8_t> read_region(const std::filesystem::path& file, const Grid& grid,
                                      const Frame& frame) {
  const SourceText source = read_source(file);
  const bool is_json = trimmed(std::string_view(source.text).substr(0, 4096)).starts_with('{');
  std::vector<std::uint8_t> cells =
      is_json ? cells_of_geojson(source, grid, frame) : cells_of_csv(source, grid);
  if (std::find(cells.begin(), cells.end(), 1) == cells.end()) {
    throw InputError(
        file.string(),
        fmt::format("holds no whole cell of the grid: its cells are {} m wide, x from {} to {}, y "
                    "from {} to {}{}",
                    length_text(grid.cell_m), coordinate_text(grid.x0_m),
                    coordinate_text(grid.x0_m + grid.width_m()), coordinate_text(grid.y0_m),
                    coordinate_text(grid.y0_m + grid.height_m()),
                    frame.is_on_earth() ? "; areas are in degrees on this map" : ""));
  }
  return cells;
}

}  // namespace fairway
