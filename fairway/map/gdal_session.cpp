#include "fairway/map/gdal_session.hpp"

#include <algorithm>
#include <mutex>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal_frmts.h>
#include <ogr_srs_api.h>

namespace fairway {

namespace {

// Only these formats: others may refer to further files or hosts (VRT, WMS), and registering all
// of GDAL's plugins takes longer than reading a map.
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

void take_error(CPLErr severity, CPLErrorNum, const char* message) {
  auto* session = static_cast<GdalSession*>(CPLGetErrorHandlerUserData());
  if (session == nullptr) return;
  if (severity >= CE_Failure) session->remember(message);
  if (severity == CE_Warning) session->remember_warning(message);
}

}  // namespace

GdalSession::GdalSession() {
  register_drivers_once();
  CPLPushErrorHandlerEx(&take_error, this);
  CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", "NO");
  CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR");
  // Accept a GeoTIFF that says its rows run north; by default GDAL reads it upside down.
  CPLSetThreadLocalConfigOption("GTIFF_HONOUR_NEGATIVE_SCALEY", "YES");
}

void GdalSession::remember_warning(const char* message) {
  if (std::find(warnings_.begin(), warnings_.end(), message) == warnings_.end())
    warnings_.emplace_back(message);
}

GdalSession::~GdalSession() {
  CPLSetThreadLocalConfigOption("GTIFF_HONOUR_NEGATIVE_SCALEY", nullptr);
  CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", nullptr);
  CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", nullptr);
  CPLPopErrorHandler();
}

}  // namespace fairway
