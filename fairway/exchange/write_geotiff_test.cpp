#include "fairway/exchange/write_geotiff.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/map/gdal_raster.hpp"
#include "fairway/map/tangent_plane.hpp"
#include "fairway/map/testing/scratch_folder.hpp"

namespace fairway {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// Opened by GDAL alone, as a GIS program would.
class Opened {
 public:
  explicit Opened(const std::filesystem::path& file) : raster_(file) {}
  GDALDataset& dataset() { return raster_.dataset(); }
  GDALRasterBand& band(int i) { return *dataset().GetRasterBand(i); }
  int width() { return dataset().GetRasterXSize(); }
  int height() { return dataset().GetRasterYSize(); }

  template <typename T>
  std::vector<T> pixels(int i, GDALDataType type) {
    std::vector<T> all(static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()));
    EXPECT_EQ(band(i).RasterIO(GF_Read, 0, 0, width(), height(), all.data(), width(), height(),
                               type, 0, 0, nullptr),
              CE_None);
    return all;
  }
  /// Of the corner of pixel (column, row), in the file's own system.
  Vec2 corner(double column, double row) {
    double t[6];
    EXPECT_EQ(dataset().GetGeoTransform(t), CE_None);
    return {t[0] + column * t[1] + row * t[2], t[3] + column * t[4] + row * t[5]};
  }
  GeodeticPoint degrees(Vec2 p) {
    OGRSpatialReference wgs84;
    wgs84.SetWellKnownGeogCS("WGS84");
    wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::unique_ptr<OGRCoordinateTransformation> to(
        OGRCreateCoordinateTransformation(dataset().GetSpatialRef(), &wgs84));
    EXPECT_NE(to, nullptr);
    EXPECT_TRUE(to && to->Transform(1, &p.x, &p.y));
    return {p.y, p.x};
  }

 private:
  GdalRaster raster_;
};

class WriteGeotiff : public ::testing::Test {
 protected:
  std::filesystem::path write(const Grid& grid, const Frame& frame,
                              const std::vector<RasterBand>& bands) {
    const std::filesystem::path file = folder_.file("out.tif");
    write_geotiff(grid, frame, bands, file, Existing::replace);
    return file;
  }
  ScratchFolder folder_;
};

TEST_F(WriteGeotiff, ValuesReadBackBitForBit) {
  Random random(5);
  for (int draw = 0; draw < 12; ++draw) {
    const Grid grid{1 + static_cast<int>(random.below(90)), 1 + static_cast<int>(random.below(70)),
                    random.uniform(-1e5, 1e5), random.uniform(-1e5, 1e5), random.uniform(0.1, 9.0)};
    std::vector<float> a(grid.size());
    std::vector<float> b(grid.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      a[i] = random.below(5) == 0 ? nan : static_cast<float>(random.uniform(-pi, pi));
      b[i] = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits() & 0x7f7fffffU));
    }
    Opened file(write(grid, {}, {{"heading", "rad", "which way", a}, {"cost", "m", "how far", b}}));
    ASSERT_EQ(file.width(), grid.nx);
    ASSERT_EQ(file.height(), grid.ny);
    const auto back_a = file.pixels<float>(1, GDT_Float32);
    const auto back_b = file.pixels<float>(2, GDT_Float32);
    for (int iy = 0; iy < grid.ny; ++iy) {
      const std::size_t from = grid.index({0, iy});
      const std::size_t at = grid.index({0, grid.ny - 1 - iy});
      const std::size_t bytes = sizeof(float) * static_cast<std::size_t>(grid.nx);
      ASSERT_EQ(std::memcmp(&back_a[at], &a[from], bytes), 0);
      ASSERT_EQ(std::memcmp(&back_b[at], &b[from], bytes), 0);
    }
    EXPECT_EQ(file.band(1).GetDescription(), std::string("heading"));
    EXPECT_EQ(file.band(1).GetUnitType(), std::string("rad"));
    EXPECT_EQ(file.band(2).GetUnitType(), std::string("m"));
    EXPECT_EQ(file.band(2).GetMetadataItem("MEANING"), std::string("how far"));
    int has = 0;
    EXPECT_TRUE(std::isnan(file.band(2).GetNoDataValue(&has)));
    EXPECT_NE(has, 0);
  }
}

TEST_F(WriteGeotiff, BytesReadBackAnd255IsNoValue) {
  const Grid grid{3, 2, 0.0, 0.0, 1.0};
  const std::vector<std::uint8_t> codes{0, 1, 2, 3, 4, 255};
  Opened file(write(grid, {}, {{"verdict", "", "", codes}}));
  EXPECT_EQ(file.pixels<std::uint8_t>(1, GDT_Byte),
            (std::vector<std::uint8_t>{3, 4, 255, 0, 1, 2}));
  EXPECT_EQ(file.band(1).GetNoDataValue(nullptr), 255.0);
}

TEST_F(WriteGeotiff, AMapInDegreesLiesWhereTheTangentPlanePutsIt) {
  Random random(6);
  for (int draw = 0; draw < 20; ++draw) {
    const GeodeticPoint reference{random.uniform(-70.0, 70.0), random.uniform(-179.0, 179.0)};
    const TangentPlane plane(reference);
    const Grid grid{20, 30, random.uniform(-2e4, 1e4), random.uniform(-2e4, 1e4), 40.0};
    const std::vector<float> values(grid.size(), 1.0F);
    Frame place;
    place.geo = GeoReference{reference.latitude_deg, reference.longitude_deg, 0.0};
    Opened file(write(grid, place, {{"x", "", "", values}}));
    for (const auto& [ix, iy] : {std::pair{0, 0}, {20, 0}, {0, 30}, {20, 30}, {7, 11}}) {
      const Vec2 here = grid.corner({ix, iy});
      const GeodeticPoint expected = plane.from_plane(here);
      const GeodeticPoint found = file.degrees(file.corner(ix, grid.ny - iy));
      // A micrometre of the plane, and what a degree's double holds.
      EXPECT_NEAR(found.latitude_deg, expected.latitude_deg, 1e-10) << "draw " << draw;
      EXPECT_NEAR(std::remainder(found.longitude_deg - expected.longitude_deg, 360.0), 0.0, 3e-10);
    }
  }
}

TEST_F(WriteGeotiff, AProjectedMapKeepsItsSystemAndItsCoordinates) {
  OGRSpatialReference utm;
  utm.importFromEPSG(32632);
  char* wkt = nullptr;
  utm.exportToWkt(&wkt);
  Frame place;
  place.projected_crs = wkt;
  CPLFree(wkt);
  const Grid grid{4, 3, 600000.0, 5199990.0, 2.5};
  const std::vector<float> values(grid.size(), 1.0F);
  Opened file(write(grid, place, {{"x", "", "", values}}));
  EXPECT_EQ(file.corner(0, 3), (Vec2{600000.0, 5199990.0}));
  EXPECT_EQ(file.corner(4, 0), (Vec2{600010.0, 5199997.5}));
  const OGRSpatialReference* system = file.dataset().GetSpatialRef();
  ASSERT_NE(system, nullptr);
  EXPECT_EQ(system->GetAuthorityCode(nullptr), std::string("32632"));

  const auto degrees = lon_lat_of(place, "plan");
  const GeodeticPoint found = file.degrees({600010.0, 5199997.5});
  const LonLat ours = degrees({600010.0, 5199997.5});
  EXPECT_NEAR(ours.latitude_deg, found.latitude_deg, 1e-12);
  EXPECT_NEAR(ours.longitude_deg, found.longitude_deg, 1e-12);
  EXPECT_NEAR(ours.latitude_deg, 46.94, 0.02);
  Frame nonsense;
  nonsense.projected_crs = "PROJCS[";
  EXPECT_THROW((void)lon_lat_of(nonsense, "plan"), InputError);
  EXPECT_FALSE(lon_lat_of({}, "plan"));
}

TEST_F(WriteGeotiff, ATurnedGridHasATurnedTransform) {
  Frame place;
  place.world_from_grid = {10.0, 20.0, pi / 6};
  const Grid grid{5, 4, 1.0, 2.0, 0.5};
  const std::vector<float> values(grid.size(), 1.0F);
  Opened file(write(grid, place, {{"x", "", "", values}}));
  for (const auto& [ix, iy] : {std::pair{0, 0}, {5, 0}, {0, 4}, {3, 1}}) {
    const Vec2 p = grid.corner({ix, iy});
    const Vec2 expected{10.0 + std::cos(pi / 6) * p.x - std::sin(pi / 6) * p.y,
                        20.0 + std::sin(pi / 6) * p.x + std::cos(pi / 6) * p.y};
    EXPECT_LT(norm(file.corner(ix, grid.ny - iy) - expected), 1e-12);
  }
  ASSERT_NE(file.dataset().GetSpatialRef(), nullptr);
  EXPECT_TRUE(file.dataset().GetSpatialRef()->IsLocal());
  EXPECT_EQ(file.dataset().GetSpatialRef()->GetLinearUnits(), 1.0);
}

TEST_F(WriteGeotiff, AppearsWholeAloneAndTheSameEachTime) {
  const Grid grid{30, 20, 0.0, 0.0, 1.0};
  const std::vector<float> values(grid.size(), 3.0F);
  const std::vector<RasterBand> bands{{"x", "", "", values}};
  const auto bytes = [](const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string first = bytes(write(grid, {}, bands));
  EXPECT_EQ(bytes(write(grid, {}, bands)), first);
  const auto entries = std::filesystem::directory_iterator(folder_.file("out.tif").parent_path());
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
  EXPECT_THROW(write_geotiff(grid, {}, bands, folder_.file("out.tif"), Existing::keep), InputError);
  EXPECT_THROW(write_geotiff(grid, {}, bands, folder_.file("no/out.tif"), Existing::keep),
               InputError);
  Frame nonsense;
  nonsense.projected_crs = "PROJCS[";
  EXPECT_THROW(write_geotiff(grid, nonsense, bands, folder_.file("out.tif"), Existing::replace),
               InputError);
  EXPECT_EQ(bytes(folder_.file("out.tif")), first);
  EXPECT_THROW(write_geotiff(grid, {}, {}, folder_.file("b.tif"), Existing::keep),
               PreconditionViolation);
  const std::vector<RasterBand> short_one{{"x", "", "", std::span(values).first(5)}};
  EXPECT_THROW(write_geotiff(grid, {}, short_one, folder_.file("b.tif"), Existing::keep),
               PreconditionViolation);
}

}  // namespace
}  // namespace fairway
