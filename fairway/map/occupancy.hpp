// The ROS reading of an image: which shades are free, occupied, unknown.
//
// occ = 1 - shade (negate: shade), shade = mean of the colours in 0..1.
//   trinary: the mean includes alpha as if it were a colour (as map_server does); occ above
//            `occupied` is an obstacle, below `free` is free, both strict, else unknown.
//   scale:   as above without alpha; pixels that are not opaque are unknown, and so is what lies
//            between the thresholds unless it rounds to 0 or 100 percent.
//   raw:     the value itself, 0 to 255, is the percentage: 0 free, 100 obstacle, else unknown;
//            negate and thresholds do not matter.
// Values that only say how likely an obstacle is (1 to 99) are not known to be free: unknown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fairway/map/image_rows.hpp"
#include "fairway/map/source_raster.hpp"

namespace fairway {

struct OccupancyRule {
  enum class Mode { trinary, scale, raw };
  Mode mode = Mode::trinary;
  double occupied = 0.65;
  double free = 0.196;
  bool negate = false;
};

/// Fills in width, height, pixels and warnings of the result; the caller sets the place.
[[nodiscard]] SourceRaster read_occupancy(const std::filesystem::path& image,
                                          const OccupancyRule& rule, std::uint64_t max_pixels);

}  // namespace fairway
