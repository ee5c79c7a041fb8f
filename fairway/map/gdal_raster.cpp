#include "fairway/map/gdal_raster.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>
#include <gdal_priv.h>

#include "fairway/base/error.hpp"
#include "fairway/map/source_text.hpp"

namespace fairway {

GdalRaster::GdalRaster(const std::filesystem::path& file) : file_(file) {
  require_regular_file(file);
  const char* drivers[] = {"GTiff", "PNG", "BMP", "JPEG", nullptr};
  const char* options[] = {"GEOREF_SOURCES=INTERNAL", nullptr};
  // An absolute name cannot be mistaken for a connection string or a virtual file.
  const std::string name = std::filesystem::absolute(file).string();
  dataset_ = static_cast<GDALDataset*>(
      GDALOpenEx(name.c_str(), GDAL_OF_READONLY | GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, drivers,
                 options, nullptr));
  if (dataset_ == nullptr) fail("cannot be opened as TIFF, PNG, BMP or JPEG");
  try {
    require_modest_blocks();
  } catch (...) {
    GDALClose(dataset_);
    throw;
  }
}

// GDAL reads whole blocks, and allocates them before it finds out what the file holds.
void GdalRaster::require_modest_blocks() const {
  constexpr std::uint64_t always_fine = std::uint64_t{1} << 24;  // pixels; tiles have 2^8 to 2^20
  const auto area = [](int width, int height) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  };
  const int width = dataset_->GetRasterXSize();
  const int height = dataset_->GetRasterYSize();
  for (int b = 1; b <= dataset_->GetRasterCount(); ++b) {
    int block_width = 0;
    int block_height = 0;
    dataset_->GetRasterBand(b)->GetBlockSize(&block_width, &block_height);
    if (area(block_width, block_height) <= std::max(area(width, height), always_fine)) continue;
    throw InputError(file_.string(),
                     fmt::format("is stored in blocks of {} x {} pixels for an image of {} x {}, "
                                 "expected no more than the image, or 2^24 pixels; gdal_translate "
                                 "makes a copy with others",
                                 block_width, block_height, width, height));
  }
}

GdalRaster::~GdalRaster() {
  if (dataset_ != nullptr) GDALClose(dataset_);
}

std::optional<std::array<double, 6>> GdalRaster::geotransform() {
  // Only TIFF has one inside; the other drivers would look for world files on their own.
  if (std::string_view(dataset_->GetDriverName()) != "GTiff") return std::nullopt;
  std::array<double, 6> transform{};
  if (dataset_->GetGeoTransform(transform.data()) != CE_None) return std::nullopt;
  return transform;
}

std::string GdalRaster::in_our_words(std::string said) const {
  const std::string absolute = std::filesystem::absolute(file_).string();
  const std::string given = file_.string();
  for (std::size_t at = said.find(absolute); at != said.npos;
       at = said.find(absolute, at + given.size()))
    said.replace(at, absolute.size(), given);
  const std::string twice = given + ":";  // GDAL may start with the name, as we do
  return said.starts_with(twice) ? std::string(trimmed(said.substr(twice.size()))) : said;
}

std::vector<std::string> GdalRaster::warnings() const {
  std::vector<std::string> warnings;
  for (const std::string& said : session_.warnings()) {
    const std::string words = in_our_words(said);
    warnings.push_back(file_.string() + ": " + words + (words.ends_with('.') ? "" : "."));
  }
  return warnings;
}

void GdalRaster::fail(const std::string& what) const {
  const std::string said = in_our_words(session_.message());
  throw InputError(file_.string(), said.empty() ? what : what + ": " + said);
}

}  // namespace fairway
