// Describes a map before there is a mission: its size, its free and connected parts, and how much
// room there is.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/map/obstacle_map.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/map/region.hpp"
#include "fairway/report/picture.hpp"

namespace fairway {

struct MapSurvey {
  ObstacleMap map;
  Grid inside;  ///< its grid without the ring of obstacles that represents the world outside
  std::size_t free_cells = 0;           ///< no obstacle; with a radius, no buffer either
  std::vector<std::size_t> part_cells;  ///< of their connected parts, the largest first
  double clearance_m = 0.0;             ///< the largest; +inf without obstacles
  std::optional<Vec2> widest_place_m;   ///< where; none when no cell is free
  std::optional<double> turn_radius_m;  ///< whose buffer was taken off
  std::vector<Region> region;           ///< free, obstacle, and buffer with a radius
};

/// A side of cells that the map's longer side has at most `across` of, and half as many at least:
/// 1, 2 or 5 times a power of ten. `request.cell_m` is not used. Reads the map a few times with
/// large cells. Throws InputError as read_map does.
[[nodiscard]] double sensible_cell_m(MapRequest request, int across);

/// With a radius, free cells are those outside its buffer at the default alpha.
[[nodiscard]] MapSurvey survey_map(const MapRequest& request, std::optional<double> turn_radius_m);

/// Where a frame lies: "not georeferenced: metres only".
[[nodiscard]] std::string earth_words(const Frame& frame);
[[nodiscard]] std::string survey_words(const MapSurvey& survey, const std::string& name);
[[nodiscard]] nlohmann::json survey_json(const MapSurvey& survey);
[[nodiscard]] Picture survey_picture(const MapSurvey& survey, const std::string& title);

}  // namespace fairway
