// World files (.wld, .pgw, .tfw ...): six lines that place an image without a geotransform.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "fairway/map/obstacle_map.hpp"

namespace fairway {

struct WorldFile {
  /// GDAL's order: x of the upper-left corner, column step (x, then its y), likewise for rows:
  /// x = t[0] + column * t[1] + row * t[2], y = t[3] + column * t[4] + row * t[5].
  std::array<double, 6> transform{};
  InputFile input;
};

/// The world file next to `image`: its name with .wld, or with the image's extension shortened to
/// first and last letter plus w (.png: .pgw), or with a w after the extension (.pngw), in upper or
/// lower case. Nothing when there is none; throws InputError with the line when it is malformed.
[[nodiscard]] std::optional<WorldFile> find_world_file(const std::filesystem::path& image);

}  // namespace fairway
