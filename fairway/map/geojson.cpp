// GeoJSON (RFC 7946): [longitude, latitude] on WGS84, closed rings.

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/map/fence_sources.hpp"
#include "fairway/map/ground_height.hpp"

namespace fairway {

namespace {

class GeoJsonReader {
 public:
  explicit GeoJsonReader(const MapRequest& request) : request_(request) {}

  void read_any(const JsonPlace& place) {
    const std::string type = place.at("type").text();
    if (type == "FeatureCollection") {
      const JsonPlace features = place.at("features");
      for (std::size_t i = 0; i < features.size(); ++i) read_feature(features.at(i));
    } else if (type == "Feature") {
      read_feature(place);
    } else {
      read_geometry(place, nullptr);
    }
  }

  GeodeticFences fences;
  std::size_t lines = 0;
  std::size_t bare_points = 0;
  std::size_t low_areas = 0;
  std::size_t untold_heights = 0;

 private:
  void read_feature(const JsonPlace& feature) {
    if (feature.at("type").text() != "Feature")
      feature.at("type").fail("is not a Feature, the only kind a FeatureCollection holds");
    const JsonPlace geometry = feature.at("geometry");
    if (geometry.value().is_null()) return;
    const JsonPlace properties =
        feature.has("properties") ? feature.at("properties") : JsonPlace(null_, feature.where());
    const bool low = is_low(properties);
    const std::size_t polygons_before = fences.polygons.size();
    const std::size_t circles_before = fences.circles.size();
    read_geometry(geometry, &properties);
    if (!low) return;
    ++low_areas;
    for (std::size_t i = polygons_before; i < fences.polygons.size(); ++i)
      for (const GeodeticRing& ring : fences.polygons[i].rings)
        fences.places.insert(fences.places.end(), ring.points.begin(), ring.points.end());
    for (std::size_t i = circles_before; i < fences.circles.size(); ++i)
      fences.places.push_back(fences.circles[i].center);
    fences.polygons.resize(polygons_before);
    fences.circles.resize(circles_before);
  }

  // Heights in metres above the datum of altitude_m; unknown heights stay obstacles.
  bool is_low(const JsonPlace& properties) {
    if (!request_.altitude_m || !properties.is_object()) return false;
    for (const auto& [key, value] : properties.value().items()) {
      const std::string name = lower(key);
      if ((name != "height" && name != "height_m") || !value.is_number()) continue;
      const auto height_m = value.get<double>();
      if (can_be_ground(height_m) && !stands_for_none(height_m))
        return height_m <= *request_.altitude_m - request_.margin_m;
      ++untold_heights;
      return false;
    }
    return false;
  }

  void read_geometry(const JsonPlace& geometry, const JsonPlace* properties) {
    const std::string type = geometry.at("type").text();
    if (type == "Polygon") {
      read_polygon(geometry.at("coordinates"), properties);
    } else if (type == "MultiPolygon") {
      const JsonPlace parts = geometry.at("coordinates");
      for (std::size_t i = 0; i < parts.size(); ++i) read_polygon(parts.at(i), properties);
    } else if (type == "Point") {
      read_point(geometry.at("coordinates"), properties);
    } else if (type == "MultiPoint") {
      const JsonPlace parts = geometry.at("coordinates");
      for (std::size_t i = 0; i < parts.size(); ++i) read_point(parts.at(i), properties);
    } else if (type == "LineString") {
      read_line(geometry.at("coordinates"));
    } else if (type == "MultiLineString") {
      const JsonPlace parts = geometry.at("coordinates");
      for (std::size_t i = 0; i < parts.size(); ++i) read_line(parts.at(i));
    } else if (type == "GeometryCollection") {
      const JsonPlace parts = geometry.at("geometries");
      for (std::size_t i = 0; i < parts.size(); ++i) read_geometry(parts.at(i), properties);
    } else {
      geometry.at("type").fail(fmt::format("is {}, expected a GeoJSON geometry", shown(type)));
    }
  }

  static bool is_keep_in(const JsonPlace* properties) {
    return properties != nullptr && properties->has("inclusion") &&
           !properties->at("inclusion").value().is_null() && properties->at("inclusion").boolean();
  }

  void read_polygon(const JsonPlace& rings, const JsonPlace* properties) {
    GeodeticPolygon polygon{is_keep_in(properties), rings.where(), {}};
    if (rings.size() == 0) rings.fail("has no ring");
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const JsonPlace positions = rings.at(r);
      GeodeticRing& ring = polygon.rings.emplace_back();
      for (std::size_t i = 0; i < positions.size(); ++i)
        ring.points.push_back(positions.at(i).longitude_latitude());
      if (ring.points.size() < 4)
        positions.fail(
            fmt::format("has {} positions, a ring needs at least 4 (the last equal to "
                        "the first)",
                        ring.points.size()));
      if (ring.points.front() != ring.points.back())
        positions.fail("is not closed: the last position differs from the first");
      ring.points.pop_back();
    }
    fences.polygons.push_back(std::move(polygon));
  }

  void read_point(const JsonPlace& position, const JsonPlace* properties) {
    for (const char* key : {"radius_m", "radius"}) {
      if (properties == nullptr || !properties->has(key)) continue;
      fences.circles.push_back({is_keep_in(properties), position.where(),
                                position.longitude_latitude(), properties->at(key).number()});
      return;
    }
    (void)position.longitude_latitude();
    ++bare_points;
  }

  void read_line(const JsonPlace& positions) {
    for (std::size_t i = 0; i < positions.size(); ++i)
      fences.places.push_back(positions.at(i).longitude_latitude());
    ++lines;
  }

  const MapRequest& request_;
  const nlohmann::json null_;
};

// Files older than RFC 7946 may name another reference system.
void require_wgs84(const JsonPlace& root) {
  if (!root.has("crs") || root.at("crs").value().is_null()) return;
  const JsonPlace crs = root.at("crs");
  if (!crs.has("properties") || !crs.at("properties").has("name"))
    crs.fail("does not name a system");
  const std::string name = crs.at("properties").at("name").text();
  if (name.find("CRS84") != name.npos || name.ends_with(":4326")) return;
  crs.fail(
      fmt::format("is {}, expected WGS84 (the only one in RFC 7946); convert it with "
                  "ogr2ogr -t_srs EPSG:4326 -lco RFC7946=YES",
                  shown(name)));
}

}  // namespace

GeodeticFences read_geojson(const SourceText& source, const nlohmann::json& json,
                            const MapRequest& request) {
  const JsonPlace root(json, source.file.string() + ": ");
  if (!root.is_object() || !root.has("type"))
    throw InputError(source.file.string(), "is not GeoJSON, the key \"type\" is missing");
  require_wgs84(root);
  GeoJsonReader reader(request);
  reader.read_any(root);
  GeodeticFences& fences = reader.fences;
  fences.inputs.push_back(source.input);
  const std::string name = source.file.string();
  if (reader.lines > 0)
    fences.warnings.push_back(
        fmt::format("{}: {} lines are not obstacles (only areas, and points "
                    "with radius_m, are).",
                    name, reader.lines));
  if (reader.bare_points > 0)
    fences.warnings.push_back(
        fmt::format("{}: {} points without radius_m are ignored.", name, reader.bare_points));
  if (reader.untold_heights > 0)
    fences.warnings.push_back(fmt::format(
        "{}: {} features have impossible heights; they count as unknown, hence as obstacles.", name,
        reader.untold_heights));
  if (reader.low_areas > 0)
    fences.warnings.push_back(fmt::format("{}: {} features are not higher than {} m and are free.",
                                          name, reader.low_areas,
                                          *request.altitude_m - request.margin_m));
  return std::move(fences);
}

}  // namespace fairway
