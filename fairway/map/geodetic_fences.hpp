// Fences in degrees, as in the files, and their conversion to metres.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fairway/map/fence_set.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/map/source_text.hpp"

namespace fairway {

/// Vertices in order, without the repeated last one. `places` says where each is in the file
/// ("FILE:LINE" or a path of keys), or is empty: then the index is added to the fence's `where`.
struct GeodeticRing {
  std::vector<GeodeticPoint> points;
  std::vector<std::size_t> lines;  ///< of each vertex in the file, or empty
};

struct GeodeticPolygon {
  bool keep_in = false;
  std::string where;  ///< "FILE: geoFence.polygons[0]", for messages
  std::vector<GeodeticRing> rings;
};

struct GeodeticCircle {
  bool keep_in = false;
  std::string where;
  GeodeticPoint center;
  double radius_m = 0.0;
};

struct GeodeticFences {
  std::vector<GeodeticPolygon> polygons;
  std::vector<GeodeticCircle> circles;
  std::vector<GeodeticPoint> places;  ///< mission items and drawn lines, to be in the world
  std::optional<GeodeticPoint> home;  ///< home position or return point
  std::vector<InputFile> inputs;
  std::vector<std::string> warnings;
};

/// Throws InputError{where, ...} unless the point is finite and in range.
void require_geodetic(const std::string& where, GeodeticPoint point);

/// Checks (every ring has three corners, is simple, lies within 180 degrees of longitude; circles
/// have a radius above 0) and projects everything into the tangent plane at `reference`, else at
/// home, else at the centre of the bounding box. Edges are straight in degrees, as autopilots
/// interpret them: they are divided until the plane's straight pieces are within 1 mm of them.
[[nodiscard]] FenceSet in_tangent_plane(const GeodeticFences& fences,
                                        std::optional<GeodeticPoint> reference);

}  // namespace fairway
