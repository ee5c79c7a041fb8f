// One raster file opened through GDAL, without network, sidecar files or output of its own.
// For the readers' own sources: nothing of GDAL shows here.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

class GDALDataset;

namespace fairway {

class GdalRaster {
 public:
  /// Opens TIFF, PNG, BMP or JPEG. Throws InputError with GDAL's reason.
  explicit GdalRaster(const std::filesystem::path& file);
  ~GdalRaster();
  GdalRaster(const GdalRaster&) = delete;
  GdalRaster& operator=(const GdalRaster&) = delete;

  GDALDataset& dataset() { return *dataset_; }

  /// The six numbers of GDAL's affine transform (corner-based: PixelIsPoint is already shifted).
  std::optional<std::array<double, 6>> geotransform();

  /// Throws InputError with what GDAL said last; `doing` completes "cannot be read: ...".
  [[noreturn]] void fail(const std::string& doing) const;

 private:
  struct Session;  // error handler and options of this thread, undone at the end
  std::unique_ptr<Session> session_;
  std::filesystem::path file_;
  GDALDataset* dataset_ = nullptr;
};

}  // namespace fairway
