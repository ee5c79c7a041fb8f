// Images as rows of samples: PGM and PPM with our own reader (GDAL supports neither the plain
// kinds nor a maximum other than 255), PNG, BMP, JPEG and TIFF through GDAL.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fairway/map/source_text.hpp"

namespace fairway {

struct ImageFormat {
  int width = 0;
  int height = 0;
  int colours = 1;            ///< 1 grey, 3 red green blue; palettes arrive as colours
  bool alpha = false;         ///< one more sample after the colours; 0 is transparent
  int max_value = 255;        ///< white, and opaque
  std::optional<int> nodata;  ///< grey value that means "no data"
  int channels() const { return colours + (alpha ? 1 : 0); }
};

/// Called once for each row, from the top; `samples` holds width * channels() interleaved samples.
using TakeRow =
    std::function<void(const ImageFormat&, int row, std::span<const std::uint16_t> samples)>;

/// Returns warnings: what a user should know about the file. Throws InputError: missing,
/// malformed, truncated, samples other than 8 or 16 bits, or more than `max_pixels`, which is
/// checked before anything is allocated.
[[nodiscard]] std::vector<std::string> read_image(const std::filesystem::path& file,
                                                  std::uint64_t max_pixels,
                                                  const TakeRow& take_row);

/// True when the first bytes are those of a PGM or PPM file (P2, P3, P5, P6).
[[nodiscard]] bool is_pnm(std::string_view head);

/// True when the first bytes are those of a PNG, BMP, JPEG or TIFF file.
[[nodiscard]] bool is_gdal_image(std::string_view head);

/// True when the extension is PGM, PPM, PNM or PBM, regardless of the content.
[[nodiscard]] bool is_pnm_file(const std::filesystem::path& file);

/// The formats read here without GDAL; `source` is the whole file. Returns warnings.
[[nodiscard]] std::vector<std::string> read_pnm(const SourceText& source, std::uint64_t max_pixels,
                                                const TakeRow& take_row);

/// Throws InputError unless both sides are at least 1 and the area is at most `max_pixels`.
void require_image_size(const std::filesystem::path& file, std::int64_t width, std::int64_t height,
                        std::uint64_t max_pixels);

}  // namespace fairway
