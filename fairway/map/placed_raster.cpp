// Images with a place: from a GeoTIFF's transform, a world file, or resolution_m alone; and
// elevation rasters, cut at a flight altitude.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/map/gdal_raster.hpp"
#include "fairway/map/ground_height.hpp"
#include "fairway/map/image_rows.hpp"
#include "fairway/map/map_sources.hpp"
#include "fairway/map/occupancy.hpp"
#include "fairway/map/world_file.hpp"

namespace fairway {

namespace {

using Transform = std::array<double, 6>;

struct Place {
  std::optional<Transform> transform;
  std::optional<std::string> projected_crs;
  std::vector<InputFile> inputs;
  std::vector<std::string> warnings;
};

GeodeticPoint centre_of(const Transform& t, int width, int height) {
  return {t[3] + 0.5 * width * t[4] + 0.5 * height * t[5],
          t[0] + 0.5 * width * t[1] + 0.5 * height * t[2]};
}

// EPSG code of the UTM zone on WGS84; near the poles, where there are no zones, the polar system.
int utm_epsg(GeodeticPoint p) {
  if (p.latitude_deg > 84.0) return 5041;
  if (p.latitude_deg < -80.0) return 5042;
  const int zone = static_cast<int>(std::floor((p.longitude_deg + 180.0) / 6.0));
  return (p.latitude_deg < 0.0 ? 32701 : 32601) + std::clamp(zone, 0, 59);
}

bool is_on_earth(GeodeticPoint p) {
  return std::abs(p.latitude_deg) <= 90.0 && std::abs(p.longitude_deg) <= 180.0;
}

std::string gdalwarp_advice(std::optional<GeodeticPoint> centre, const char* source = "") {
  if (!centre || !is_on_earth(*centre))
    return fmt::format(
        "reproject it first: gdalwarp {}-t_srs EPSG:326ZZ IN OUT, ZZ the UTM zone (south of the "
        "equator 327ZZ)",
        source);
  return fmt::format("reproject it first: gdalwarp {}-t_srs EPSG:{} IN OUT", source,
                     utm_epsg(*centre));
}

/// Where on Earth a point of any system is; nothing when PROJ cannot say.
std::optional<GeodeticPoint> on_wgs84(const OGRSpatialReference& system, GeodeticPoint point) {
  const GdalSession quiet;
  OGRSpatialReference wgs84;
  if (wgs84.SetWellKnownGeogCS("WGS84") != OGRERR_NONE) return std::nullopt;
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRSpatialReference from(system);
  from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> way(
      OGRCreateCoordinateTransformation(&from, &wgs84));
  double x = point.longitude_deg;
  double y = point.latitude_deg;
  if (!way || way->Transform(1, &x, &y) == 0 || !std::isfinite(x) || !std::isfinite(y))
    return std::nullopt;
  return GeodeticPoint{y, x};
}

// Its metres hold at the equator; elsewhere lengths, and so turning radii, come out too short.
void warn_of_mercator(const std::string& file, const OGRSpatialReference& system,
                      GeodeticPoint centre, Place& place) {
  const char* method = system.GetAttrValue("PROJECTION");
  const std::string_view name = method == nullptr ? "" : method;
  if (!name.starts_with("Mercator") && name.find("Pseudo_Mercator") == name.npos) return;
  const auto there = on_wgs84(system, centre);
  if (!there) return;
  const double scale = 1.0 / std::cos(there->latitude_deg * (pi / 180.0));
  if (scale < 1.01) return;
  place.warnings.push_back(
      fmt::format("{}: is in Mercator projection, where a metre on the ground is {:.2f} m on the "
                  "map; {}.",
                  file, scale, gdalwarp_advice(there)));
}

void require_metres(const MapRequest& request, GDALDataset& dataset, Place& place) {
  const OGRSpatialReference* system = dataset.GetSpatialRef();
  if (system == nullptr || !place.transform) return;
  const std::string file = request.file.string();
  const GeodeticPoint centre =
      centre_of(*place.transform, dataset.GetRasterXSize(), dataset.GetRasterYSize());
  if (system->IsGeographic())
    throw InputError(file, "is in degrees, expected metres; " +
                               gdalwarp_advice(on_wgs84(*system, centre).value_or(centre)));
  const char* unit = nullptr;
  const double metres = system->GetLinearUnits(&unit);
  if (std::abs(metres - 1.0) > 1e-12)
    throw InputError(file, fmt::format("is in units of {} ({} m), expected metres; {}", unit,
                                       metres, gdalwarp_advice(on_wgs84(*system, centre))));
  if (!system->IsProjected()) return;
  warn_of_mercator(file, *system, centre, place);
  char* wkt = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  if (system->exportToWkt(&wkt, options) == OGRERR_NONE && wkt != nullptr)
    place.projected_crs = wkt;
  CPLFree(wkt);
}

// Without a reference system, degrees show only in small pixels at coordinates that are a valid
// latitude and longitude: pixels below a millimetre, or below 30 cm for heights. If the user states
// the size of a pixel in metres, that is accepted.
void require_no_degrees_in_disguise(const MapRequest& request, const SourceRaster& raster,
                                    const Place& place) {
  if (!place.transform || place.projected_crs || request.resolution_m) return;
  const Transform& t = *place.transform;
  const GeodeticPoint centre = centre_of(t, raster.width, raster.height);
  const double pixel = std::max(std::abs(t[1]), std::abs(t[5]));
  if (pixel < (request.altitude_m ? 0.3 : 1e-3) && is_on_earth(centre) && is_on_earth({t[3], t[0]}))
    throw InputError(
        request.file.string(),
        fmt::format("has pixels of {} units at ({}, {}): degrees instead of metres; {} (or set "
                    "map.resolution_m if they are metres)",
                    t[1], t[0], t[3], gdalwarp_advice(centre, "-s_srs EPSG:4326 ")));
}

Place find_place(const MapRequest& request, GdalRaster* raster) {
  Place place;
  if (raster != nullptr) {
    place.transform = raster->geotransform();
    require_metres(request, raster->dataset(), place);
  }
  if (!place.transform) {
    if (const auto world = find_world_file(request.file)) {
      place.transform = world->transform;
      place.inputs.push_back(world->input);
    }
  }
  return place;
}

void flip(SourceRaster& raster, bool columns, bool rows) {
  if (columns)
    for (int r = 0; r < raster.height; ++r)
      std::reverse(raster.row(r), raster.row(r) + raster.width);
  if (rows)
    for (int r = 0; r < raster.height / 2; ++r)
      std::swap_ranges(raster.row(r), raster.row(r) + raster.width,
                       raster.row(raster.height - 1 - r));
}

void put_in_place(SourceRaster& raster, const Place& place, const MapRequest& request) {
  raster.projected_crs = place.projected_crs;
  raster.inputs.insert(raster.inputs.end(), place.inputs.begin(), place.inputs.end());
  if (!place.transform) {
    if (!request.resolution_m)
      throw InputError(request.file.string(),
                       "has neither geotransform nor world file; map.resolution_m is missing "
                       "(metres per pixel)");
    raster.pixel_width_m = raster.pixel_height_m = *request.resolution_m;
    return;
  }
  const Transform& t = *place.transform;
  for (const double value : t)
    if (!std::isfinite(value))
      throw InputError(request.file.string(), "has a geotransform that is not finite");
  if (t[2] != 0.0 || t[4] != 0.0)
    throw InputError(request.file.string(),
                     "is rotated or sheared, expected rows along x; straighten "
                     "it with gdalwarp");
  if (t[1] == 0.0 || t[5] == 0.0)
    throw InputError(request.file.string(), "has a geotransform with pixels of size 0");
  raster.pixel_width_m = std::abs(t[1]);
  raster.pixel_height_m = std::abs(t[5]);
  require_agreeing_resolution(request, raster.pixel_width_m);
  raster.lower_left_m = {std::min(t[0], t[0] + raster.width * t[1]),
                         std::min(t[3], t[3] + raster.height * t[5])};
  flip(raster, t[1]<0.0, t[5]> 0.0);
}

// Heights that mean "none": impossible for ground on Earth, or values that programs write for
// unknown heights, when no tag of the file says so.
class Voids {
 public:
  Voids(const MapRequest& request, GDALRasterBand& band) : file_(request.file.string()) {
    int has_nodata = 0;
    nodata_ = band.GetNoDataValue(&has_nodata);
    has_nodata_ = has_nodata != 0;
  }

  /// `sample` as stored in the file, `height_m` its meaning.
  bool take(double sample, double height_m) {
    if (has_nodata_ && (sample == nodata_ || (std::isnan(sample) && std::isnan(nodata_))))
      return true;
    if (can_be_ground(height_m) && !stands_for_none(sample)) return false;
    ++untagged_;
    const std::string value = fmt::format("{}", static_cast<float>(sample));
    if (values_.size() < 3 && std::find(values_.begin(), values_.end(), value) == values_.end())
      values_.push_back(value);
    return true;
  }

  void warn(std::vector<std::string>& warnings) const {
    if (untagged_ == 0) return;
    warnings.push_back(
        fmt::format("{}: {} pixels have heights that cannot be ground ({}), without a nodata tag "
                    "for them; they count as unknown. To tag them: gdal_edit.py -a_nodata {} {}",
                    file_, untagged_, fmt::join(values_, ", "), values_.front(), file_));
  }

 private:
  std::string file_;
  double nodata_ = 0.0;
  bool has_nodata_ = false;
  std::uint64_t untagged_ = 0;
  std::vector<std::string> values_;
};

GDALRasterBand& band_of_heights(GDALDataset& dataset, const std::string& file) {
  if (dataset.GetRasterCount() != 1)
    throw InputError(file, fmt::format("has {} bands, expected one in an elevation raster",
                                       dataset.GetRasterCount()));
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  if (GDALDataTypeIsComplex(band.GetRasterDataType()))
    throw InputError(file, "has complex samples, expected heights");
  const std::string unit = lower(band.GetUnitType());
  if (!unit.empty() && unit != "m" && unit != "metre" && unit != "meter" && unit != "metres" &&
      unit != "meters")
    throw InputError(file, fmt::format("has heights in {}, expected metres", shown(unit)));
  return band;
}

SourceRaster read_elevation(const MapRequest& request, GdalRaster& gdal) {
  GDALDataset& dataset = gdal.dataset();
  GDALRasterBand& band = band_of_heights(dataset, request.file.string());
  SourceRaster raster;
  raster.width = dataset.GetRasterXSize();
  raster.height = dataset.GetRasterYSize();
  require_image_size(request.file, raster.width, raster.height, request.max_pixels);
  raster.pixels.resize(static_cast<std::size_t>(raster.width) *
                       static_cast<std::size_t>(raster.height));
  Voids voids(request, band);
  const double scale = band.GetScale();
  const double offset = band.GetOffset();
  const double limit_m = *request.altitude_m - request.margin_m;
  std::vector<double> samples(static_cast<std::size_t>(raster.width));
  for (int row = 0; row < raster.height; ++row) {
    if (band.RasterIO(GF_Read, 0, row, raster.width, 1, samples.data(), raster.width, 1,
                      GDT_Float64, 0, 0, nullptr) != CE_None)
      gdal.fail(fmt::format("cannot be read at pixel row {}", row));
    Pixel* out = raster.row(row);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double height_m = scale * samples[i] + offset;
      out[i] = voids.take(samples[i], height_m) ? Pixel::unknown
               : height_m > limit_m             ? Pixel::obstacle
                                                : Pixel::free;
    }
  }
  voids.warn(raster.warnings);
  return raster;
}

}  // namespace

SourceRaster read_placed_raster(const MapRequest& request) {
  std::optional<GdalRaster> gdal;
  if (!is_pnm_file(request.file)) gdal.emplace(request.file);
  const Place place = find_place(request, gdal ? &*gdal : nullptr);
  SourceRaster raster;
  if (request.altitude_m) {
    if (!gdal)
      throw InputError(request.file.string(), "is not an elevation raster (map.altitude_m)");
    raster = read_elevation(request, *gdal);
  } else {
    raster = read_occupancy(request.file, OccupancyRule{}, request.max_pixels);
  }
  if (gdal) {
    for (std::string& warning : gdal->warnings())
      if (std::find(raster.warnings.begin(), raster.warnings.end(), warning) ==
          raster.warnings.end())
        raster.warnings.push_back(std::move(warning));
  }
  raster.warnings.insert(raster.warnings.end(), place.warnings.begin(), place.warnings.end());
  require_no_degrees_in_disguise(request, raster, place);
  raster.inputs.push_back({request.file.string(), sha256_file(request.file)});
  put_in_place(raster, place, request);
  return raster;
}

}  // namespace fairway
