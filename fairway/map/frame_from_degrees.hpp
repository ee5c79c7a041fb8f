// Points in degrees on a georeferenced map.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "fairway/base/frame.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/map/read_map.hpp"

namespace fairway {

/// True when the map comes from degrees or from a projected raster.
[[nodiscard]] bool has_geographic_frame(const ObstacleMap& map);

class FrameFromDegrees {
 public:
  /// Throws InputError{file, ...} when the map has no geographic frame or PROJ cannot convert.
  FrameFromDegrees(const ObstacleMap& map, const std::filesystem::path& file);
  FrameFromDegrees(const Frame& frame, const std::string& where);
  ~FrameFromDegrees();
  FrameFromDegrees(const FrameFromDegrees&) = delete;
  FrameFromDegrees& operator=(const FrameFromDegrees&) = delete;

  /// Coordinates of the map's grid, metres. Throws InputError{where, ...} where there are none.
  [[nodiscard]] Vec2 point_m(const std::string& where, GeodeticPoint point) const;

 private:
  struct Conversion;
  std::unique_ptr<Conversion> conversion_;
};

}  // namespace fairway
