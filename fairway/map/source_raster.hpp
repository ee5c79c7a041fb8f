// What every image reader returns: pixels that are free, obstacle or unknown, and where they lie.
//
// Row 0 is the top, as in image files. Pixel (column, row) covers, from `lower_left_m`,
// [column * pixel_width_m, ...] to the right and [(height - 1 - row) * pixel_height_m, ...]
// upwards.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/map/obstacle_map.hpp"

namespace fairway {

enum class Pixel : std::uint8_t { free = 0, obstacle = 1, unknown = 2 };

struct SourceRaster {
  int width = 0;
  int height = 0;
  double pixel_width_m = 1.0;
  double pixel_height_m = 1.0;
  Vec2 lower_left_m;
  std::vector<Pixel> pixels;  ///< [row][column], row 0 at the top
  WorldFromGrid world_from_grid;
  std::optional<std::string> projected_crs;  ///< WKT
  std::vector<InputFile> inputs;
  std::vector<std::string> warnings;

  const Pixel* row(int r) const {
    return pixels.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(width);
  }
  Pixel* row(int r) {
    return pixels.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(width);
  }
};

}  // namespace fairway
