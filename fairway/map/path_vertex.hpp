// A vertex of a path as given in its file.
#pragma once

#include <string>
#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/map/source_text.hpp"

namespace fairway {

struct PathVertex {
  std::string where;  ///< "FILE:LINE" or a path of keys
  Vec2 point_m;       ///< in the frame of the map's grid
};

/// CSV (path_csv.cpp); see read_path.hpp.
[[nodiscard]] std::vector<PathVertex> read_path_csv(const SourceText& source,
                                                    const ObstacleMap& frame);

}  // namespace fairway
