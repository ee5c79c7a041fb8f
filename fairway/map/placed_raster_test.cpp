#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include "fairway/map/read_map.hpp"
#include "fairway/map/read_path.hpp"
#include "fairway/map/testing/scratch_folder.hpp"

namespace fairway {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Tiff {
  GDALDataType type = GDT_Float32;
  int epsg = 32632;
  std::vector<double> transform = {600000.0, 2.0, 0.0, 5200000.0, 0.0, -2.0};
  std::optional<double> nodata;
  bool pixel_is_point = false;
};

// Three by two pixels.
void write_tiff(const std::filesystem::path& file, const Tiff& tiff,
                std::vector<double> values = {10, 20, 30, 40, 50, 60}) {
  GDALRegister_GTiff();
  auto* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const auto dataset = std::unique_ptr<GDALDataset>(
      driver->Create(file.string().c_str(), 3, 2, 1, tiff.type, nullptr));
  ASSERT_NE(dataset, nullptr);
  if (tiff.epsg != 0) {
    OGRSpatialReference system;
    ASSERT_EQ(system.importFromEPSG(tiff.epsg), OGRERR_NONE);
    dataset->SetSpatialRef(&system);
  }
  if (tiff.pixel_is_point) dataset->SetMetadataItem("AREA_OR_POINT", "Point");
  if (!tiff.transform.empty()) dataset->SetGeoTransform(const_cast<double*>(tiff.transform.data()));
  if (tiff.nodata) dataset->GetRasterBand(1)->SetNoDataValue(*tiff.nodata);
  ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 3, 2, values.data(), 3, 2,
                                                GDT_Float64, 0, 0, nullptr),
            CE_None);
}

// A GeoTIFF written byte by byte, as GDAL would not: three by two heights, with the scale given.
std::string tiff_with_scale(double scale_x, double scale_y, const std::vector<float>& heights) {
  std::string bytes("II*\0\x08\0\0\0", 8);
  const auto append = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  constexpr std::uint16_t entries = 12;
  constexpr std::uint32_t data = 8 + 2 + 12 * entries + 4;
  constexpr std::uint32_t scale = data;
  constexpr std::uint32_t tie = scale + 24;
  constexpr std::uint32_t pixels = tie + 48;
  append(entries);
  const auto entry = [&](std::uint16_t tag, std::uint16_t type, std::uint32_t count,
                         std::uint32_t value) {
    append(tag);
    append(type);
    append(count);
    append(value);
  };
  constexpr std::uint16_t u16 = 3;
  constexpr std::uint16_t u32 = 4;
  constexpr std::uint16_t f64 = 12;
  entry(256, u32, 1, 3);  // width
  entry(257, u32, 1, 2);  // height
  entry(258, u16, 1, 32);
  entry(259, u16, 1, 1);  // not compressed
  entry(262, u16, 1, 1);
  entry(273, u32, 1, pixels);
  entry(277, u16, 1, 1);
  entry(278, u32, 1, 2);
  entry(279, u32, 1, 24);
  entry(339, u16, 1, 3);  // floats
  entry(33550, f64, 3, scale);
  entry(33922, f64, 6, tie);
  append(std::uint32_t{0});
  for (const double value : {scale_x, scale_y, 0.0}) append(value);
  for (const double value : {0.0, 0.0, 0.0, 600000.0, 5200000.0, 0.0}) append(value);
  for (const float height : heights) append(height);
  return bytes;
}

class PlacedRaster : public ::testing::Test {
 protected:
  MapRequest request(const std::string& name) const {
    MapRequest request;
    request.file = folder_.file(name);
    request.cell_m = 2.0;
    request.outside_is_obstacle = false;
    return request;
  }
  MapRequest at_altitude(double altitude_m) const {
    MapRequest result = request("a.tif");
    result.altitude_m = altitude_m;
    return result;
  }
  static std::string error(const MapRequest& request) {
    return input_error_of([&] { (void)read_map(request); });
  }
  ScratchFolder folder_;
};

TEST_F(PlacedRaster, GroundAboveTheAltitudeMinusTheMarginBlocks) {
  write_tiff(folder_.file("a.tif"), {});
  MapRequest request = at_altitude(45.0);
  const ObstacleMap map = read_map(request);
  EXPECT_EQ(map.grid, (Grid{3, 2, 600000.0, 5199996.0, 2.0}));
  EXPECT_EQ(map.obstacle, (std::vector<std::uint8_t>{0, 1, 1, 0, 0, 0}));
  EXPECT_TRUE(map.frame.projected_crs.has_value());
  EXPECT_FALSE(map.frame.geo.has_value());
  request.margin_m = 15.0;  // 30 is not above 45 - 15
  EXPECT_EQ(read_map(request).obstacle, (std::vector<std::uint8_t>{1, 1, 1, 0, 0, 0}));
  request.margin_m = 15.001;
  EXPECT_EQ(read_map(request).obstacle, (std::vector<std::uint8_t>{1, 1, 1, 0, 0, 1}));
}

TEST_F(PlacedRaster, PixelsWithoutDataAreUnknown) {
  Tiff tiff;
  tiff.nodata = 20.0;
  write_tiff(folder_.file("a.tif"), tiff, {10, 20, std::nan(""), 10, 10, 10});
  MapRequest request = at_altitude(100.0);
  EXPECT_EQ(read_map(request).obstacle, (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 1}));
  request.unknown_is_obstacle = false;
  EXPECT_EQ(read_map(request).obstacle, std::vector<std::uint8_t>(6, 0));
}

TEST_F(PlacedRaster, RowsAndColumnsMayRunEitherWay) {
  Tiff tiff;
  tiff.transform = {600006.0, -2.0, 0.0, 5199996.0, 0.0, 2.0};
  write_tiff(folder_.file("a.tif"), tiff);
  const ObstacleMap map = read_map(at_altitude(45.0));
  EXPECT_EQ(map.grid, (Grid{3, 2, 600000.0, 5199996.0, 2.0}));
  EXPECT_EQ(map.obstacle, (std::vector<std::uint8_t>{0, 0, 0, 1, 1, 0}));
}

TEST_F(PlacedRaster, AScaleThatRunsNorthIsAccepted) {
  const std::vector<float> heights = {10, 20, 30, 40, 50, 60};  // the first row first
  folder_.write("a.tif", tiff_with_scale(2.0, 2.0, heights));
  const ObstacleMap north_up = read_map(at_altitude(45.0));
  EXPECT_EQ(north_up.grid, (Grid{3, 2, 600000.0, 5199996.0, 2.0}));
  EXPECT_EQ(north_up.obstacle, (std::vector<std::uint8_t>{0, 1, 1, 0, 0, 0}));
  folder_.write("a.tif", tiff_with_scale(2.0, -2.0, heights));
  const ObstacleMap south_up = read_map(at_altitude(45.0));
  EXPECT_EQ(south_up.grid, (Grid{3, 2, 600000.0, 5200000.0, 2.0}));
  EXPECT_EQ(south_up.obstacle, (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 1}));
}

TEST_F(PlacedRaster, WarningsOfGdalArePassedOn) {
  std::string bytes = tiff_with_scale(2.0, 2.0, {10, 20, 30, 40, 50, 60});
  const auto entry = [&](int i) { return bytes.begin() + 8 + 2 + 12 * i; };
  std::swap_ranges(entry(8), entry(9), entry(9));  // tags out of order
  folder_.write("a.tif", bytes);
  ::testing::internal::CaptureStderr();
  const ObstacleMap map = read_map(at_altitude(45.0));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(map.obstacle, (std::vector<std::uint8_t>{0, 1, 1, 0, 0, 0}));
  EXPECT_THAT(map.warnings,
              ::testing::ElementsAre(AllOf(StartsWith(folder_.file("a.tif").string() + ": "),
                                           HasSubstr("not sorted in ascending order"))));
}

TEST_F(PlacedRaster, HeightsThatCannotBeGroundAreUnknownWithAWarning) {
  for (const double none : {-32768.0, -32767.0, -9999.0, -99999.0, -3.4028234663852886e38, 1e20,
                            32767.0, std::nan(""), -HUGE_VAL}) {
    write_tiff(folder_.file("a.tif"), {}, {none, 20, none, 10, 10, 10});
    MapRequest request = at_altitude(1e9);  // above every number
    const ObstacleMap map = read_map(request);
    EXPECT_EQ(map.obstacle, (std::vector<std::uint8_t>{0, 0, 0, 1, 0, 1})) << none;
    EXPECT_THAT(map.warnings, ::testing::ElementsAre(AllOf(
                                  HasSubstr("a.tif: 2 pixels have heights that cannot be ground ("),
                                  HasSubstr("gdal_edit.py -a_nodata"))))
        << none;
    request.unknown_is_obstacle = false;
    EXPECT_EQ(read_map(request).obstacle, std::vector<std::uint8_t>(6, 0));
    Tiff tagged;
    tagged.nodata = none;
    write_tiff(folder_.file("a.tif"), tagged, {none, 20, none, 10, 10, 10});
    EXPECT_THAT(read_map(at_altitude(1e9)).warnings, ::testing::IsEmpty()) << none;
    EXPECT_EQ(read_map(at_altitude(1e9)).obstacle, map.obstacle) << none;
  }
  // The Dead Sea, Everest, and the deepest sea are ground.
  write_tiff(folder_.file("a.tif"), {}, {-430, 8849, -10935, 0, -1, 5.5});
  EXPECT_THAT(read_map(at_altitude(1e9)).warnings, ::testing::IsEmpty());
  EXPECT_EQ(read_map(at_altitude(1e9)).obstacle, std::vector<std::uint8_t>(6, 0));
}

TEST_F(PlacedRaster, PixelIsPointIsShiftedByHalfAPixel) {
  Tiff tiff;
  tiff.pixel_is_point = true;
  write_tiff(folder_.file("a.tif"), tiff);
  // GDAL writes the shifted tie point and shifts back: the corner stays where it was given.
  EXPECT_EQ(read_map(at_altitude(45.0)).grid.x0_m, 600000.0);
}

TEST_F(PlacedRaster, DegreesAreRefusedWithAdvice) {
  Tiff tiff;
  tiff.epsg = 4326;
  tiff.transform = {8.54, 1e-5, 0.0, 47.4, 0.0, -1e-5};
  write_tiff(folder_.file("a.tif"), tiff);
  EXPECT_EQ(error(at_altitude(45.0)),
            "a.tif: is in degrees, expected metres; reproject it first: gdalwarp -t_srs EPSG:32632 "
            "IN OUT");
  tiff.transform = {-70.3, 1e-5, 0.0, -33.4, 0.0, -1e-5};
  write_tiff(folder_.file("a.tif"), tiff);
  EXPECT_THAT(error(at_altitude(45.0)), HasSubstr("EPSG:32719"));
  tiff.epsg = 0;
  write_tiff(folder_.file("a.tif"), tiff);
  EXPECT_THAT(error(at_altitude(45.0)),
              AllOf(HasSubstr("degrees instead of metres"),
                    HasSubstr("gdalwarp -s_srs EPSG:4326 -t_srs EPSG:32719 IN OUT")));
  // Half a minute of arc per pixel; far north there are no zones.
  tiff.transform = {20.0, 0.5 / 60.0, 0.0, 85.0, 0.0, -0.5 / 60.0};
  write_tiff(folder_.file("a.tif"), tiff);
  EXPECT_THAT(error(at_altitude(45.0)), HasSubstr("EPSG:5041"));
  MapRequest metres = at_altitude(45.0);
  metres.resolution_m = 0.5 / 60.0;  // stated by the user
  metres.cell_m = 0.5 / 60.0;
  EXPECT_EQ(error(metres), "no error");
}

TEST_F(PlacedRaster, OtherUnitsTurnedRastersAndFloatsWithoutAltitudeAreRefused) {
  Tiff tiff;
  tiff.epsg = 2263;  // New York Long Island, US survey feet
  tiff.transform = {984250.0, 10.0, 0.0, 200000.0, 0.0, -10.0};
  write_tiff(folder_.file("a.tif"), tiff);
  EXPECT_THAT(error(at_altitude(45.0)),
              AllOf(HasSubstr("US survey foot"), HasSubstr("gdalwarp -t_srs EPSG:32618 IN OUT")));
  tiff = {};
  tiff.transform = {600000.0, 2.0, 0.1, 5200000.0, 0.1, -2.0};
  write_tiff(folder_.file("a.tif"), tiff);
  EXPECT_EQ(error(at_altitude(45.0)),
            "a.tif: is rotated or sheared, expected rows along x; straighten it with gdalwarp");
  write_tiff(folder_.file("a.tif"), {});
  EXPECT_EQ(error(request("a.tif")),
            "a.tif: has samples of type Float32, expected 8 or 16 bits; elevations need a flight "
            "altitude (map.altitude_m)");
}

TEST_F(PlacedRaster, MercatorsMetresAreWarnedAbout) {
  Tiff tiff;
  tiff.epsg = 3857;
  tiff.transform = {1000000.0, 2.0, 0.0, 6000000.0, 0.0, -2.0};  // 47.4 degrees north
  write_tiff(folder_.file("a.tif"), tiff);
  EXPECT_THAT(read_map(at_altitude(45.0)).warnings,
              ::testing::ElementsAre(AllOf(HasSubstr("is 1.48 m on the map"),
                                           HasSubstr("gdalwarp -t_srs EPSG:32632 IN OUT"))));
  tiff.transform = {1000000.0, 2.0, 0.0, 100000.0, 0.0, -2.0};  // near the equator
  write_tiff(folder_.file("a.tif"), tiff);
  EXPECT_THAT(read_map(at_altitude(45.0)).warnings, ::testing::IsEmpty());
}

TEST_F(PlacedRaster, AnEightBitTiffIsAnOccupancyImage) {
  Tiff tiff;
  tiff.type = GDT_Byte;
  tiff.nodata = 7;
  write_tiff(folder_.file("a.tif"), tiff, {255, 0, 255, 7, 255, 128});
  MapRequest request = this->request("a.tif");
  EXPECT_EQ(read_map(request).obstacle, (std::vector<std::uint8_t>{1, 0, 1, 0, 1, 0}));
  request.unknown_is_obstacle = false;
  EXPECT_EQ(read_map(request).obstacle, (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0}));
}

TEST_F(PlacedRaster, AWorldFilePlacesABareImage) {
  folder_.write("a.pgm", "P2 2 1 255 0 255");
  // Steps of 2 m; the centre of the upper-left pixel is at (11, 21).
  for (const char* name : {"a.pmw", "a.pgmw", "a.wld", "a.PMW", "A.Wld", "a.PgmW"}) {
    const auto file = folder_.write(name, "2.0\r\n0\r\n0\r\n-2.0\r\n11.0\r\n21.0\r\n");
    const ObstacleMap map = read_map(request("a.pgm"));
    EXPECT_EQ(map.grid, (Grid{2, 1, 10.0, 20.0, 2.0})) << name;
    EXPECT_EQ(map.obstacle, (std::vector<std::uint8_t>{1, 0}));
    EXPECT_EQ(map.inputs.size(), 2U);
    std::filesystem::remove(file);
  }
  folder_.write("a.pmw", "2.0\n0\nnorth\n-2.0\n11.0\n21.0\n");
  EXPECT_EQ(error(request("a.pgm")), "a.pmw:3: \"north\" is not a finite number");
  folder_.write("a.pmw", "2.0\n0\n0\n");
  EXPECT_EQ(error(request("a.pgm")), "a.pmw: has 3 numbers, expected six in a world file");
  folder_.write("a.pmw", "2.0\n1\n1\n-2.0\n11.0\n21.0\n");
  EXPECT_THAT(error(request("a.pgm")), HasSubstr("is rotated or sheared"));
  folder_.write("a.pmw", "0.00002\n0\n0\n-0.00002\n8.5\n47.3\n");
  EXPECT_THAT(error(request("a.pgm")),
              AllOf(HasSubstr("degrees instead of metres"), HasSubstr("EPSG:32632")));
}

TEST_F(PlacedRaster, ABareImageNeedsAResolutionAndLiesAtTheOrigin) {
  folder_.write("a.pgm", "P2 2 1 255 0 255");
  EXPECT_EQ(error(request("a.pgm")),
            "a.pgm: has neither geotransform nor world file; map.resolution_m is missing (metres "
            "per pixel)");
  MapRequest request = this->request("a.pgm");
  request.resolution_m = 4.0;
  EXPECT_EQ(read_map(request).grid, (Grid{4, 2, 0.0, 0.0, 2.0}));
}

TEST_F(PlacedRaster, APathInDegreesIsPlacedOnAProjectedMap) {
  write_tiff(folder_.file("a.tif"), {});
  const ObstacleMap map = read_map(at_altitude(45.0));
  // Two points of the map, converted to degrees by PROJ itself.
  OGRSpatialReference utm;
  OGRSpatialReference wgs84;
  utm.importFromEPSG(32632);
  wgs84.importFromEPSG(4326);
  utm.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const auto to_degrees =
      std::unique_ptr<OGRCoordinateTransformation>(OGRCreateCoordinateTransformation(&utm, &wgs84));
  const std::vector<Vec2> expected = {{600001.0, 5199997.0}, {600005.0, 5199999.0}};
  std::string csv = "lat,lon\n";
  for (const Vec2 p : expected) {
    double x = p.x;
    double y = p.y;
    ASSERT_TRUE(to_degrees->Transform(1, &x, &y));
    char line[80];
    std::snprintf(line, sizeof line, "%.12f,%.12f\n", y, x);
    csv += line;
  }
  const auto path = read_path(folder_.write("p.csv", csv), map);
  ASSERT_EQ(path.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(norm(path[i] - expected[i]), 1e-4);
}

}  // namespace
}  // namespace fairway
