#include "fairway/report/page_frame.hpp"

#include <cmath>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr int across = 17;

/// Eight decimals: about a millimetre.
double rounded(double degrees) { return std::round(degrees * 1e8) / 1e8; }

json lattice(const Grid& grid, const LonLatOf& lon_lat) {
  json lat = json::array();
  json lon = json::array();
  double before = 0.0;
  for (int row = 0; row < across; ++row) {
    for (int column = 0; column < across; ++column) {
      const LonLat at = lon_lat({grid.x0_m + grid.width_m() * column / (across - 1),
                                 grid.y0_m + grid.height_m() * row / (across - 1)});
      if (!std::isfinite(at.latitude_deg) || !std::isfinite(at.longitude_deg)) return {};
      double longitude = at.longitude_deg;
      if (!lon.empty()) longitude += 360.0 * std::round((before - longitude) / 360.0);
      lat.push_back(rounded(at.latitude_deg));
      lon.push_back(rounded(longitude));
      before = longitude;
    }
  }
  return {{"across", across}, {"lat_deg", std::move(lat)}, {"lon_deg", std::move(lon)}};
}

}  // namespace

json page_frame_json(const Grid& grid, const Frame& frame, const LonLatOf& lon_lat) {
  json earth;
  try {
    if (lon_lat) earth = lattice(grid, lon_lat);
  } catch (const InputError&) {
    earth = nullptr;
  }
  return {{"yaw_rad", frame.world_from_grid.yaw_rad}, {"earth", std::move(earth)}};
}

}  // namespace fairway
