// Values over a grid as a GeoTIFF, georeferenced if the map was.
//
// Properties that always hold:
//   1. Values read back bit for bit, the pixel of row r and column c being cell (c, ny - 1 - r):
//      images have their highest row first.
//   2. The place is that of the grid: in the map's projected system; else, for maps in degrees, in
//      the azimuthal equidistant one about the map's reference point, whose axes are the tangent
//      plane's; else in metres of a local system. A grid that is rotated in its world has a rotated
//      transform.
//   3. The bytes depend on the arguments and the version of GDAL alone: no times, no sidecar files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/frame.hpp"
#include "fairway/base/grid.hpp"

namespace fairway {

struct RasterBand {
  std::string name;     ///< shown by GIS programs
  std::string unit;     ///< "m", "rad", or empty
  std::string meaning;  ///< a sentence for people
  /// [iy][ix], all of one kind in a file. Without value: NaN, or no_value_byte.
  std::variant<std::span<const float>, std::span<const std::uint8_t>> values;
};
inline constexpr std::uint8_t no_value_byte = 255;

/// Writes it whole or not at all. Throws InputError when the place cannot be written or the record
/// names a reference system that GDAL does not understand, PreconditionViolation when bands are
/// missing, of several kinds, or not as large as the grid.
void write_geotiff(const Grid& grid, const Frame& frame, std::span<const RasterBand> bands,
                   const std::filesystem::path& path, Existing existing);

}  // namespace fairway
