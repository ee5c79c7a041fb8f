// Images that carry their place: a GeoTIFF's transform, a world file, or resolution_m alone; and
// elevation rasters, cut at a flight altitude.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/map/gdal_raster.hpp"
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
};

std::string utm_advice(const Transform& t, int width, int height) {
  const double longitude = t[0] + 0.5 * width * t[1];
  const double latitude = t[3] + 0.5 * height * t[5];
  if (!(std::abs(longitude) <= 180.0)) return "reproject it first with gdalwarp -t_srs";
  const int zone = std::min(static_cast<int>(std::floor((longitude + 180.0) / 6.0)) + 1, 60);
  return fmt::format("reproject it first: gdalwarp -t_srs EPSG:{} IN OUT",
                     (latitude < 0.0 ? 32700 : 32600) + zone);
}

void require_metres(const MapRequest& request, GDALDataset& dataset, Place& place) {
  const OGRSpatialReference* system = dataset.GetSpatialRef();
  if (system == nullptr || !place.transform) return;
  const std::string file = request.file.string();
  if (system->IsGeographic())
    throw InputError(
        file, "is in degrees, expected metres; " +
                  utm_advice(*place.transform, dataset.GetRasterXSize(), dataset.GetRasterYSize()));
  const char* unit = nullptr;
  const double metres = system->GetLinearUnits(&unit);
  if (std::abs(metres - 1.0) > 1e-12)
    throw InputError(file, fmt::format("is in units of {} ({} m), expected metres; reproject it "
                                       "with gdalwarp -t_srs",
                                       unit, metres));
  if (!system->IsProjected()) return;
  char* wkt = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  if (system->exportToWkt(&wkt, options) == OGRERR_NONE && wkt != nullptr)
    place.projected_crs = wkt;
  CPLFree(wkt);
}

// Without a reference system nothing says degrees, but pixels of less than a millimetre do.
void require_no_degrees_in_disguise(const MapRequest& request, const Place& place) {
  if (!place.transform || place.projected_crs) return;
  const Transform& t = *place.transform;
  if (std::abs(t[1]) < 1e-3 && std::abs(t[0]) <= 180.0 && std::abs(t[3]) <= 90.0)
    throw InputError(request.file.string(),
                     fmt::format("has pixels of {} units at ({}, {}): degrees where metres belong; "
                                 "reproject it with gdalwarp -t_srs",
                                 t[1], t[0], t[3]));
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
  require_no_degrees_in_disguise(request, place);
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
                     "is turned or sheared, expected rows along x; straighten "
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

SourceRaster read_elevation(const MapRequest& request, GdalRaster& gdal) {
  GDALDataset& dataset = gdal.dataset();
  const std::string file = request.file.string();
  if (dataset.GetRasterCount() != 1)
    throw InputError(
        file, fmt::format("has {} bands, an elevation raster has one", dataset.GetRasterCount()));
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  if (GDALDataTypeIsComplex(band.GetRasterDataType()))
    throw InputError(file, "has complex samples, expected heights");
  const std::string unit = lower(band.GetUnitType());
  if (!unit.empty() && unit != "m" && unit != "metre" && unit != "meter" && unit != "metres" &&
      unit != "meters")
    throw InputError(file, fmt::format("has heights in {}, expected metres", shown(unit)));
  SourceRaster raster;
  raster.width = dataset.GetRasterXSize();
  raster.height = dataset.GetRasterYSize();
  require_image_size(request.file, raster.width, raster.height, request.max_pixels);
  raster.pixels.resize(static_cast<std::size_t>(raster.width) *
                       static_cast<std::size_t>(raster.height));
  int has_nodata = 0;
  const double nodata = band.GetNoDataValue(&has_nodata);
  const double scale = band.GetScale();
  const double offset = band.GetOffset();
  const double limit_m = *request.altitude_m - request.margin_m;
  std::vector<double> heights(static_cast<std::size_t>(raster.width));
  for (int row = 0; row < raster.height; ++row) {
    if (band.RasterIO(GF_Read, 0, row, raster.width, 1, heights.data(), raster.width, 1,
                      GDT_Float64, 0, 0, nullptr) != CE_None)
      gdal.fail(fmt::format("cannot be read at pixel row {}", row));
    Pixel* out = raster.row(row);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const double height_m = scale * heights[i] + offset;
      const bool known = std::isfinite(height_m) && !(has_nodata != 0 && heights[i] == nodata);
      out[i] = !known ? Pixel::unknown : height_m > limit_m ? Pixel::obstacle : Pixel::free;
    }
  }
  return raster;
}

bool is_pnm_file(const std::filesystem::path& file) {
  const std::string extension = lower(file.extension().string());
  return extension == ".pgm" || extension == ".ppm" || extension == ".pnm";
}

}  // namespace

SourceRaster read_placed_raster(const MapRequest& request) {
  std::optional<GdalRaster> gdal;
  if (!is_pnm_file(request.file)) gdal.emplace(request.file);
  const Place place = find_place(request, gdal ? &*gdal : nullptr);
  SourceRaster raster;
  if (request.altitude_m) {
    if (!gdal) throw InputError(request.file.string(), "is no elevation raster (map.altitude_m)");
    raster = read_elevation(request, *gdal);
  } else {
    raster = read_occupancy(request.file, OccupancyRule{}, request.max_pixels);
  }
  raster.inputs.push_back({request.file.string(), sha256_file(request.file)});
  put_in_place(raster, place, request);
  return raster;
}

}  // namespace fairway
