#include "fairway/map/degrees_from_frame.hpp"

#include <cmath>
#include <memory>

#include <ogr_spatialref.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/map/gdal_session.hpp"
#include "fairway/map/tangent_plane.hpp"

namespace fairway {

namespace {

std::shared_ptr<OGRCoordinateTransformation> to_degrees(const std::string& projected_crs,
                                                        const std::string& where) {
  const GdalSession session;
  OGRSpatialReference from;
  OGRSpatialReference to;
  std::shared_ptr<OGRCoordinateTransformation> projection;
  if (from.importFromWkt(projected_crs.c_str()) == OGRERR_NONE &&
      to.SetWellKnownGeogCS("WGS84") == OGRERR_NONE) {
    from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    to.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    projection.reset(OGRCreateCoordinateTransformation(&from, &to));
  }
  if (!projection) {
    throw InputError(where, "unknown reference system: " + session.message());
  }
  return projection;
}

}  // namespace

LonLatOf lon_lat_of(const Frame& frame, const std::string& where) {
  if (frame.geo) {
    const TangentPlane plane({frame.geo->latitude_deg, frame.geo->longitude_deg});
    return [plane](Vec2 position_m) {
      const GeodeticPoint point = plane.from_plane(position_m);
      return LonLat{point.longitude_deg, point.latitude_deg};
    };
  }
  if (!frame.projected_crs) return {};
  return [projection = to_degrees(*frame.projected_crs, where), where](Vec2 position_m) {
    const GdalSession session;
    double x = position_m.x;
    double y = position_m.y;
    if (projection->Transform(1, &x, &y) == 0 || !std::isfinite(x) || !std::isfinite(y)) {
      throw InputError(where, place_text(position_m) + " is outside its reference system");
    }
    return LonLat{x, y};
  };
}

}  // namespace fairway
