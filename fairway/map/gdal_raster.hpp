// One raster file opened through GDAL. For the readers only: hides GDAL's own headers.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fairway/map/gdal_session.hpp"

class GDALDataset;

namespace fairway {

class GdalRaster {
 public:
  /// Opens TIFF, PNG, BMP or JPEG. Throws InputError with GDAL's reason, and for files whose blocks
  /// would take far more memory than the image.
  explicit GdalRaster(const std::filesystem::path& file);
  ~GdalRaster();
  GdalRaster(const GdalRaster&) = delete;
  GdalRaster& operator=(const GdalRaster&) = delete;

  GDALDataset& dataset() { return *dataset_; }

  /// The six numbers of GDAL's affine transform (corner-based: PixelIsPoint is already shifted),
  /// for files that contain one.
  std::optional<std::array<double, 6>> geotransform();

  /// GDAL's warnings so far, each with the file's name.
  [[nodiscard]] std::vector<std::string> warnings() const;

  /// Throws InputError: `what`, then GDAL's last message.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void require_modest_blocks() const;
  /// GDAL's message, with the file's name as the user gave it.
  [[nodiscard]] std::string in_our_words(std::string said) const;

  GdalSession session_;
  std::filesystem::path file_;
  GDALDataset* dataset_ = nullptr;
};

}  // namespace fairway
