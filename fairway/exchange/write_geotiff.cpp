#include "fairway/exchange/write_geotiff.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "fairway/base/error.hpp"
#include "fairway/map/gdal_session.hpp"

namespace fairway {

namespace {

/// A file in memory: what GDAL wrote becomes a product in one go, or nothing does.
class MemoryFile {
 public:
  MemoryFile() {
    static std::atomic<unsigned> count{0};
    name_ = fmt::format("/vsimem/fairway-{}.tif", ++count);
  }
  ~MemoryFile() { VSIUnlink(name_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& name() const { return name_; }
  std::span<const std::byte> bytes() const {
    vsi_l_offset size = 0;
    const GByte* data = VSIGetMemFileBuffer(name_.c_str(), &size, FALSE);
    return {reinterpret_cast<const std::byte*>(data), static_cast<std::size_t>(size)};
  }

 private:
  std::string name_;
};

struct Close {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, Close>;

[[noreturn]] void fail(const std::filesystem::path& path, const GdalSession& session,
                       const std::string& what) {
  throw InputError(path.string(),
                   session.message().empty() ? what : what + ": " + session.message());
}

std::array<double, 6> transform_of(const Grid& grid, const WorldFromGrid& world) {
  const double c = world.yaw_rad == 0.0 ? 1.0 : std::cos(world.yaw_rad);
  const double s = world.yaw_rad == 0.0 ? 0.0 : std::sin(world.yaw_rad);
  const Vec2 top_left{grid.x0_m, grid.y0_m + grid.height_m()};
  return {world.x_m + c * top_left.x - s * top_left.y, c * grid.cell_m, s * grid.cell_m,
          world.y_m + s * top_left.x + c * top_left.y, s * grid.cell_m, -c * grid.cell_m};
}

void set_system(GDALDataset& file, const Frame& frame, const std::filesystem::path& path,
                const GdalSession& session) {
  OGRSpatialReference system;
  OGRErr error = OGRERR_NONE;
  if (frame.projected_crs) {
    error = system.importFromWkt(frame.projected_crs->c_str());
  } else if (frame.geo) {
    system.SetProjCS(fmt::format("Fairway tangent plane about {} {}", frame.geo->latitude_deg,
                                 frame.geo->longitude_deg)
                         .c_str());
    error = system.SetWellKnownGeogCS("WGS84");
    if (error == OGRERR_NONE) {
      error = system.SetAE(frame.geo->latitude_deg, frame.geo->longitude_deg, 0.0, 0.0);
    }
  } else {
    system.SetLocalCS("metres of the map");
    error = system.SetLinearUnits(SRS_UL_METER, 1.0);
  }
  system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (error != OGRERR_NONE || file.SetSpatialRef(&system) != CE_None) {
    fail(path, session, "cannot store the map's reference system");
  }
}

template <typename T>
bool write_rows(GDALRasterBand& band, GDALDataType type, const Grid& grid,
                std::span<const T> values) {
  for (int row = 0; row < grid.ny; ++row) {
    // GDAL takes the data it writes through a non-const pointer.
    auto* cells = const_cast<T*>(values.data() + grid.index({0, grid.ny - 1 - row}));
    if (band.RasterIO(GF_Write, 0, row, grid.nx, 1, cells, grid.nx, 1, type, 0, 0, nullptr) !=
        CE_None) {
      return false;
    }
  }
  return true;
}

bool write_band(GDALRasterBand& band, const Grid& grid, const RasterBand& content) {
  band.SetDescription(content.name.c_str());
  if (!content.unit.empty()) band.SetUnitType(content.unit.c_str());
  band.SetMetadataItem("MEANING", content.meaning.c_str());
  if (const auto* numbers = std::get_if<std::span<const float>>(&content.values)) {
    return write_rows(band, GDT_Float32, grid, *numbers);
  }
  return write_rows(band, GDT_Byte, grid, std::get<std::span<const std::uint8_t>>(content.values));
}

void require_fitting(const Grid& grid, std::span<const RasterBand> bands) {
  require(!bands.empty() && grid.nx > 0 && grid.ny > 0, "a raster has bands and cells");
  for (const RasterBand& band : bands) {
    require(band.values.index() == bands.front().values.index(), "bands are of one kind");
    const std::size_t size = std::visit([](const auto& v) { return v.size(); }, band.values);
    require(size == grid.size(), "a band has a value for each cell");
  }
}

}  // namespace

void write_geotiff(const Grid& grid, const Frame& frame, std::span<const RasterBand> bands,
                   const std::filesystem::path& path, Existing existing) {
  require_fitting(grid, bands);
  AtomicFile product(path, existing);
  const GdalSession session;
  const MemoryFile memory;
  const bool is_float = bands.front().values.index() == 0;
  const std::string predictor = is_float ? "PREDICTOR=3" : "PREDICTOR=2";
  const char* const options[] = {"COMPRESS=DEFLATE", predictor.c_str(), "INTERLEAVE=BAND",
                                 "BIGTIFF=IF_SAFER", "NUM_THREADS=1",   nullptr};
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  require(driver != nullptr, "GDAL writes GeoTIFF");
  Dataset file(driver->Create(memory.name().c_str(), grid.nx, grid.ny,
                              static_cast<int>(bands.size()), is_float ? GDT_Float32 : GDT_Byte,
                              const_cast<char**>(options)));
  if (!file) fail(path, session, "cannot be written");
  std::array<double, 6> transform = transform_of(grid, frame.world_from_grid);
  if (file->SetGeoTransform(transform.data()) != CE_None) {
    fail(path, session, "cannot be georeferenced");
  }
  set_system(*file, frame, path, session);
  for (std::size_t i = 0; i < bands.size(); ++i) {
    GDALRasterBand& band = *file->GetRasterBand(static_cast<int>(i) + 1);
    band.SetNoDataValue(is_float ? std::numeric_limits<double>::quiet_NaN()
                                 : static_cast<double>(no_value_byte));
    if (!write_band(band, grid, bands[i])) fail(path, session, "cannot be written");
  }
  file->FlushCache(true);
  file.reset();
  if (!session.message().empty()) fail(path, session, "cannot be written");
  product.write(memory.bytes());
  product.commit();
}

}  // namespace fairway
