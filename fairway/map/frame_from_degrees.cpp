#include "fairway/map/frame_from_degrees.hpp"

#include <cmath>
#include <optional>

#include <ogr_spatialref.h>

#include "fairway/base/error.hpp"
#include "fairway/map/gdal_session.hpp"
#include "fairway/map/geodetic_fences.hpp"
#include "fairway/map/tangent_plane.hpp"

namespace fairway {

struct FrameFromDegrees::Conversion {
  GdalSession session;
  std::optional<TangentPlane> plane;
  std::unique_ptr<OGRCoordinateTransformation> projection;
};

bool has_geographic_frame(const ObstacleMap& map) { return map.frame.is_on_earth(); }

FrameFromDegrees::FrameFromDegrees(const ObstacleMap& map, const std::filesystem::path& file)
    : FrameFromDegrees(map.frame, file.string()) {}

FrameFromDegrees::FrameFromDegrees(const Frame& frame, const std::string& where)
    : conversion_(std::make_unique<Conversion>()) {
  if (frame.geo) {
    conversion_->plane.emplace(GeodeticPoint{frame.geo->latitude_deg, frame.geo->longitude_deg});
    return;
  }
  if (!frame.projected_crs)
    throw InputError(where,
                     "is in degrees, but the map is not georeferenced; expected x_m "
                     "and y_m in the map's metres");
  OGRSpatialReference from;
  OGRSpatialReference to;
  if (from.SetWellKnownGeogCS("WGS84") != OGRERR_NONE ||
      to.importFromWkt(frame.projected_crs->c_str()) != OGRERR_NONE)
    throw InputError(where, "cannot be placed on the map: unknown reference system: " +
                                conversion_->session.message());
  from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  to.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  conversion_->projection.reset(OGRCreateCoordinateTransformation(&from, &to));
  if (!conversion_->projection)
    throw InputError(where, "cannot be placed on the map: " + conversion_->session.message());
}

FrameFromDegrees::~FrameFromDegrees() = default;

Vec2 FrameFromDegrees::point_m(const std::string& where, GeodeticPoint point) const {
  require_geodetic(where, point);
  if (conversion_->plane) return conversion_->plane->to_plane_m(point);
  double x = point.longitude_deg;
  double y = point.latitude_deg;
  if (!conversion_->projection->Transform(1, &x, &y) || !std::isfinite(x) || !std::isfinite(y))
    throw InputError(where, "is outside the map's reference system");
  return {x, y};
}

}  // namespace fairway
