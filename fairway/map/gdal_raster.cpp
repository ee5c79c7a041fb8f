#include "fairway/map/gdal_raster.hpp"

#include <string_view>

#include <gdal_priv.h>

#include "fairway/base/error.hpp"
#include "fairway/map/source_text.hpp"

namespace fairway {

GdalRaster::GdalRaster(const std::filesystem::path& file) : file_(file) {
  require_regular_file(file);
  const char* drivers[] = {"GTiff", "PNG", "BMP", "JPEG", nullptr};
  const char* options[] = {"GEOREF_SOURCES=INTERNAL", nullptr};
  // An absolute name cannot be taken for a connection string or a virtual file.
  const std::string name = std::filesystem::absolute(file).string();
  dataset_ = static_cast<GDALDataset*>(
      GDALOpenEx(name.c_str(), GDAL_OF_READONLY | GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, drivers,
                 options, nullptr));
  if (dataset_ == nullptr) fail("cannot be opened as TIFF, PNG, BMP or JPEG");
}

GdalRaster::~GdalRaster() {
  if (dataset_ != nullptr) GDALClose(dataset_);
}

std::optional<std::array<double, 6>> GdalRaster::geotransform() {
  // Only TIFF carries one inside; the other drivers would look for world files by themselves.
  if (std::string_view(dataset_->GetDriverName()) != "GTiff") return std::nullopt;
  std::array<double, 6> transform{};
  if (dataset_->GetGeoTransform(transform.data()) != CE_None) return std::nullopt;
  return transform;
}

std::vector<std::string> GdalRaster::warnings() const {
  std::vector<std::string> warnings;
  for (const std::string& said : session_.warnings()) {
    std::string_view what = said;
    const std::string open_name = std::filesystem::absolute(file_).string() + ":";
    if (what.starts_with(open_name)) what.remove_prefix(open_name.size());
    warnings.push_back(file_.string() + ": " + std::string(trimmed(what)) +
                       (what.ends_with('.') ? "" : "."));
  }
  return warnings;
}

void GdalRaster::fail(const std::string& what) const {
  throw InputError(file_.string(),
                   session_.message().empty() ? what : what + ": " + session_.message());
}

}  // namespace fairway
