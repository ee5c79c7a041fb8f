// The map as planning sees it: a grid of cells, each an obstacle or not, and where it came from.
//
// Properties that always hold: obstacle.size() == grid.size(); a cell is 1 if any obstacle point,
// grown by the footprint, lies in it (conservative), else 0; the grid's frame is metres, x to the
// right of the source map, y up.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fairway/base/frame.hpp"
#include "fairway/base/grid.hpp"

namespace fairway {

/// A file that went into a product, with its SHA-256 in lower-case hex.
struct InputFile {
  std::string path;
  std::string sha256;
};

struct ObstacleMap {
  Grid grid;
  std::vector<std::uint8_t> obstacle;  ///< [iy][ix], 1 obstacle, 0 not
  Frame frame;
  std::vector<InputFile> inputs;
  std::vector<std::string> warnings;  ///< what the user should know, one sentence each
};

}  // namespace fairway
