#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gdal_priv.h>

#include "fairway/base/error.hpp"
#include "fairway/map/gdal_raster.hpp"
#include "fairway/map/image_rows.hpp"

namespace fairway {

namespace {

std::vector<GDALColorEntry> palette_of(GDALRasterBand& band) {
  std::vector<GDALColorEntry> palette;
  if (const GDALColorTable* table = band.GetColorTable())
    for (int i = 0; i < table->GetColorEntryCount(); ++i)
      palette.push_back(*table->GetColorEntry(i));
  return palette;
}

// Samples of fewer than 8 bits (or, rarely, 9 to 15) come with their own maximum.
int max_value_of(GDALRasterBand& band) {
  if (const char* bits = band.GetMetadataItem("NBITS", "IMAGE_STRUCTURE")) {
    const int n = std::atoi(bits);
    if (n >= 1 && n <= 16) return (1 << n) - 1;
  }
  return band.GetRasterDataType() == GDT_Byte ? 255 : 65535;
}

struct Layout {
  ImageFormat format;                   // of the rows passed on
  std::vector<GDALColorEntry> palette;  // not empty: one band of indices
  int bands = 1;                        // in the file
  bool white_is_zero = false;
};

Layout layout_of(GdalRaster& raster, const std::filesystem::path& file) {
  GDALDataset& dataset = raster.dataset();
  Layout layout;
  layout.bands = dataset.GetRasterCount();
  layout.format.width = dataset.GetRasterXSize();
  layout.format.height = dataset.GetRasterYSize();
  if (layout.bands < 1 || layout.bands > 4)
    throw InputError(file.string(), fmt::format("has {} bands, expected grey, grey and alpha, RGB "
                                                "or RGBA",
                                                layout.bands));
  for (int b = 1; b <= layout.bands; ++b) {
    const GDALDataType type = dataset.GetRasterBand(b)->GetRasterDataType();
    if (type != GDT_Byte && type != GDT_UInt16)
      throw InputError(file.string(),
                       fmt::format("has samples of type {}, expected 8 or 16 bits; elevations need "
                                   "a flight altitude (map.altitude_m)",
                                   GDALGetDataTypeName(type)));
  }
  GDALRasterBand& first = *dataset.GetRasterBand(1);
  layout.format.max_value = max_value_of(first);
  if (layout.bands == 1) layout.palette = palette_of(first);
  if (!layout.palette.empty()) {
    layout.format.colours = 3;
    layout.format.max_value = 255;
    layout.format.alpha = std::any_of(layout.palette.begin(), layout.palette.end(),
                                      [](const GDALColorEntry& c) { return c.c4 != 255; });
    return layout;
  }
  layout.format.colours = layout.bands >= 3 ? 3 : 1;
  layout.format.alpha = layout.bands % 2 == 0;
  if (layout.format.alpha &&
      dataset.GetRasterBand(layout.bands)->GetColorInterpretation() != GCI_AlphaBand)
    throw InputError(file.string(), fmt::format("band {} is not alpha, expected grey, grey and "
                                                "alpha, RGB or RGBA",
                                                layout.bands));
  const char* white = dataset.GetMetadataItem("MINISWHITE", "IMAGE_STRUCTURE");
  if (white == nullptr) white = first.GetMetadataItem("MINISWHITE", "IMAGE_STRUCTURE");
  layout.white_is_zero = white != nullptr && std::string_view(white) == "YES";
  int has_nodata = 0;
  const double nodata = first.GetNoDataValue(&has_nodata);
  if (has_nodata != 0 && layout.format.colours == 1 && nodata >= 0.0 &&
      nodata <= layout.format.max_value && nodata == static_cast<int>(nodata))
    layout.format.nodata = static_cast<int>(nodata);
  return layout;
}

void apply_palette(const Layout& layout, std::span<const std::uint16_t> indices,
                   std::vector<std::uint16_t>& samples, const std::filesystem::path& file) {
  std::size_t out = 0;
  for (const std::uint16_t index : indices) {
    if (index >= layout.palette.size())
      throw InputError(file.string(), fmt::format("a pixel has colour {} of a palette of {}", index,
                                                  layout.palette.size()));
    const GDALColorEntry& colour = layout.palette[index];
    for (const short c : {colour.c1, colour.c2, colour.c3})
      samples[out++] = static_cast<std::uint16_t>(std::clamp<short>(c, 0, 255));
    if (layout.format.alpha)
      samples[out++] = static_cast<std::uint16_t>(std::clamp<short>(colour.c4, 0, 255));
  }
}

// Some files have larger values than their bit depth allows; and white may be zero.
void tidy_row(const Layout& layout, std::span<std::uint16_t> samples) {
  const auto max = static_cast<std::uint16_t>(layout.format.max_value);
  if (max != 255 && max != 65535)
    for (auto& s : samples) s = std::min(s, max);
  if (layout.white_is_zero && layout.format.colours == 1)
    for (std::size_t i = 0; i < samples.size(); i += static_cast<std::size_t>(layout.bands))
      samples[i] = static_cast<std::uint16_t>(max - std::min(samples[i], max));
}

}  // namespace

bool is_gdal_image(std::string_view head) {
  using namespace std::string_view_literals;
  return head.starts_with("\x89PNG"sv) || head.starts_with("BM"sv) || head.starts_with("II*\0"sv) ||
         head.starts_with("MM\0*"sv) || head.starts_with("II+\0"sv) ||
         head.starts_with("MM\0+"sv) || head.starts_with("\xff\xd8\xff"sv);
}

std::vector<std::string> read_image(const std::filesystem::path& file, std::uint64_t max_pixels,
                                    const TakeRow& take_row) {
  require_regular_file(file);
  {
    std::FILE* stream = std::fopen(file.string().c_str(), "rb");
    char head[40] = {};
    const std::size_t got = stream == nullptr ? 0 : std::fread(head, 1, sizeof head, stream);
    if (stream != nullptr) std::fclose(stream);
    if (is_pnm({head, got}) ||
        ((is_pnm_file(file) || head[0] == '#') && !is_gdal_image({head, got})))
      return read_pnm(read_bytes(file, std::uint64_t{4} << 30), max_pixels, take_row);
  }
  GdalRaster raster(file);
  require_image_size(file, raster.dataset().GetRasterXSize(), raster.dataset().GetRasterYSize(),
                     max_pixels);
  const Layout layout = layout_of(raster, file);
  const auto width = static_cast<std::size_t>(layout.format.width);
  const std::size_t per_row = width * static_cast<std::size_t>(layout.bands);
  const int chunk =
      std::clamp(static_cast<int>((std::size_t{1} << 21) / per_row), 1, layout.format.height);
  std::vector<std::uint16_t> block(per_row * static_cast<std::size_t>(chunk));
  std::vector<std::uint16_t> colours(width * static_cast<std::size_t>(layout.format.channels()));
  for (int top = 0; top < layout.format.height; top += chunk) {
    const int rows = std::min(chunk, layout.format.height - top);
    const auto pixel_bytes = static_cast<GSpacing>(2 * layout.bands);
    const CPLErr result =
        raster.dataset().RasterIO(GF_Read, 0, top, layout.format.width, rows, block.data(),
                                  layout.format.width, rows, GDT_UInt16, layout.bands, nullptr,
                                  pixel_bytes, pixel_bytes * layout.format.width, 2, nullptr);
    if (result != CE_None) raster.fail(fmt::format("cannot be read at pixel row {}", top));
    for (int r = 0; r < rows; ++r) {
      const std::span<std::uint16_t> row(block.data() + per_row * static_cast<std::size_t>(r),
                                         per_row);
      if (!layout.palette.empty()) {
        apply_palette(layout, row, colours, file);
        take_row(layout.format, top + r, colours);
      } else {
        tidy_row(layout, row);
        take_row(layout.format, top + r, row);
      }
    }
  }
  return raster.warnings();
}

}  // namespace fairway
