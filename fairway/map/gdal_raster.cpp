#include "fairway/map/gdal_raster.hpp"

#include <mutex>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <ogr_srs_api.h>

#include "fairway/base/error.hpp"
#include "fairway/map/source_text.hpp"

namespace fairway {

namespace {

// Only these formats: others may name further files or hosts (VRT, WMS), and registering all of
// GDAL's plugins takes longer than reading a map.
void register_drivers_once() {
  static std::once_flag once;
  std::call_once(once, [] {
    GDALRegister_GTiff();
    GDALRegister_PNG();
    GDALRegister_BMP();
    GDALRegister_JPEG();
    OSRSetPROJEnableNetwork(0);
  });
}

}  // namespace

struct GdalRaster::Session {
  Session() {
    CPLPushErrorHandlerEx(&Session::remember, this);
    CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", "NO");
    CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR");
  }
  ~Session() {
    CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", nullptr);
    CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", nullptr);
    CPLPopErrorHandler();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  static void remember(CPLErr severity, CPLErrorNum, const char* message) {
    auto* self = static_cast<Session*>(CPLGetErrorHandlerUserData());
    if (self != nullptr && severity >= CE_Failure) self->message = message;
  }

  std::string message;
};

GdalRaster::GdalRaster(const std::filesystem::path& file) : file_(file) {
  require_regular_file(file);
  register_drivers_once();
  session_ = std::make_unique<Session>();
  const char* drivers[] = {"GTiff", "PNG", "BMP", "JPEG", nullptr};
  const char* options[] = {"GEOREF_SOURCES=INTERNAL", nullptr};
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

void GdalRaster::fail(const std::string& doing) const {
  std::string what = doing;
  if (session_ && !session_->message.empty()) what += ": " + session_->message;
  throw InputError(file_.string(), what);
}

}  // namespace fairway
