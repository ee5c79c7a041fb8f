#include "fairway/map/image_rows.hpp"

#include <memory>
#include <string>
#include <vector>

#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fairway/base/random.hpp"
#include "fairway/map/occupancy.hpp"
#include "fairway/map/testing/scratch_folder.hpp"

namespace fairway {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Image {
  ImageFormat format;
  std::vector<int> samples;
};

Image load(const std::filesystem::path& file, std::uint64_t max_pixels = 1 << 20) {
  Image image;
  int next_row = 0;
  (void)read_image(file, max_pixels,
                   [&](const ImageFormat& format, int row, std::span<const std::uint16_t> samples) {
                     EXPECT_EQ(row, next_row++);
                     image.format = format;
                     image.samples.insert(image.samples.end(), samples.begin(), samples.end());
                   });
  EXPECT_EQ(next_row, image.format.height);
  return image;
}

// Writes through GDAL: `samples` interleaved, `bands` per pixel.
void write_gdal(const std::filesystem::path& file, const char* driver, GDALDataType type, int width,
                int height, int bands, std::vector<std::uint16_t> samples,
                const GDALColorTable* palette = nullptr,
                const std::vector<const char*>& options = {}) {
  GDALRegister_PNG();
  GDALRegister_GTiff();
  GDALRegister_BMP();
  GDALRegister_MEM();
  auto* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  const auto source =
      std::unique_ptr<GDALDataset>(memory->Create("", width, height, bands, type, nullptr));
  ASSERT_NE(source, nullptr);
  ASSERT_EQ(source->RasterIO(GF_Write, 0, 0, width, height, samples.data(), width, height,
                             GDT_UInt16, bands, nullptr, 2 * bands, 2 * bands * width, 2, nullptr),
            CE_None);
  if (bands % 2 == 0) source->GetRasterBand(bands)->SetColorInterpretation(GCI_AlphaBand);
  if (palette != nullptr)
    source->GetRasterBand(1)->SetColorTable(const_cast<GDALColorTable*>(palette));
  std::vector<const char*> ending = options;
  ending.push_back(nullptr);
  const auto copy =
      std::unique_ptr<GDALDataset>(GetGDALDriverManager()->GetDriverByName(driver)->CreateCopy(
          file.string().c_str(), source.get(), 0, const_cast<char**>(ending.data()), nullptr,
          nullptr));
  ASSERT_NE(copy, nullptr);
}

TEST(Pnm, EveryKindReadsTheSamePixels) {
  const ScratchFolder folder;
  const std::vector<int> expected = {0, 7, 255, 130};
  for (const char* text : {"P2 2 2 255 0 7 255 130", "P2\n#c\n2\n#d\n2 # e\n255\n0 7\n255\t130\n",
                           "P2\r\n2 2\r\n255\r\n0 7\r\n255 130"}) {
    const Image image = load(folder.write("a.pgm", text));
    EXPECT_EQ(image.samples, expected) << text;
    EXPECT_EQ(image.format.max_value, 255);
  }
  EXPECT_EQ(load(folder.write("b.pgm", std::string("P5 2 2 255\n\x00\x07\xff\x82", 15))).samples,
            expected);
  EXPECT_EQ(load(folder.write("c.pgm", std::string("P5 2 1 1000\n\x00\x07\x03\xe8", 16))).samples,
            (std::vector<int>{7, 1000}))
      << "above 255: two bytes, high byte first";
  EXPECT_EQ(load(folder.write("d.ppm", "P3 1 1 9 1 2 3")).samples, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(load(folder.write("e.ppm", "P6 1 1 255\nabc")).samples,
            (std::vector<int>{'a', 'b', 'c'}));
}

TEST(Pnm, CommentsStandAnywhereInTheHeader) {
  const ScratchFolder folder;
  const std::vector<int> expected = {'a', 'b'};
  for (const char* text :
       {"P5 # c\n2 1 255\nab", "P5\n# c\n# d\n2 1\n# 9 9\n255\nab", "P5 2# c\n1# c\n255\nab",
        "P5 2 1 255# touching\nab", "P5\r# c\r2 1\r255\rab", "P5#c\n2 1 255\nab"})
    EXPECT_EQ(load(folder.write("a.pgm", text)).samples, expected) << text;
}

TEST(Pnm, BytesLeftOverAreWarnedAbout) {
  const ScratchFolder folder;
  const auto warnings = [&](std::string_view bytes) {
    const auto ignore = [](const ImageFormat&, int, std::span<const std::uint16_t>) {};
    return read_image(folder.write("a.pgm", bytes), 100, ignore);
  };
  for (const char* exact : {"P5 2 1 255\nab", "P2 2 1 255 1 2", "P2 2 1 255 1 2\n\n# end\n"})
    EXPECT_THAT(warnings(exact), ::testing::IsEmpty()) << exact;
  // Strictly, the comment is the first pixels, as in other readers.
  EXPECT_THAT(warnings("P5 2 1 255 # x\nab"),
              ::testing::ElementsAre(::testing::AllOf(
                  HasSubstr("a.pgm: 4 bytes after the last pixel are ignored"),
                  HasSubstr("a comment after the maximum value is read as pixels"))));
  EXPECT_THAT(warnings("P5 2 1 255\r\nab"),
              ::testing::ElementsAre(HasSubstr("1 byte after the last pixel is ignored")));
  EXPECT_THAT(warnings("P2 2 1 255 1 2 3"), ::testing::ElementsAre(HasSubstr("1 byte")));
}

TEST(Pnm, AFileThatStartsOtherwiseGivesAnErrorSayingHowAPgmStarts) {
  const ScratchFolder folder;
  for (const auto& [begin, shown] : {std::pair("# by hand\nP5 1 1 255\na", "\"# by hand\""),
                                     {"P4\n8 1\n\xff", "\"P4\""},
                                     {"\nP5 1 1 255\na", "\"\""},
                                     {"<html>", "\"<html>\""}})
    EXPECT_EQ(input_error_of([&] { (void)load(folder.write("a.PGM", begin)); }),
              std::string("a.PGM:1: starts with ") + shown +
                  "; a PGM starts with P5 or P2 and a PPM with P6 or P3, before any comment");
  EXPECT_THAT(input_error_of([&] { (void)load(folder.write("map.png", "# x\nP5 1 1 255\na")); }),
              StartsWith("map.png:1: starts with \"# x\"; a PGM starts with"));
}

TEST(Pnm, WhatIsWrongIsNamed) {
  const ScratchFolder folder;
  const auto error = [&](std::string_view bytes) {
    return input_error_of([&] { (void)load(folder.write("a.pgm", bytes)); });
  };
  EXPECT_EQ(error("P5 2 2 255\nabc"),
            "a.pgm:1: is truncated: 3 bytes of pixels, expected 4 for 2 by 2 pixels");
  EXPECT_EQ(error("P5\n2 2\n255"), "a.pgm:3: ends before the pixels");
  EXPECT_EQ(error("P5\n2\n"), "a.pgm:3: ends before the height");
  EXPECT_EQ(error("P5\n-2 2\n255\n"), "a.pgm:2: the width is not a whole number");
  EXPECT_EQ(error("P5\n0 2\n255\n"), "a.pgm: the image is empty (0 by 2 pixels)");
  EXPECT_EQ(error("P5\n1 1\n0\na"), "a.pgm:3: the maximum value is 0, expected 1 to 65535");
  EXPECT_EQ(error("P5\n1 1\n70000\na"),
            "a.pgm:3: the maximum value is 70000, expected at most 65535");
  EXPECT_EQ(error("P5\n99999999999 1\n255\na"),
            "a.pgm:2: the width is 99999999999, expected at most 1073741824");
  EXPECT_EQ(error("P2\n1 1\n9\n12"), "a.pgm:4: the pixel value is 12, expected at most 9");
  EXPECT_EQ(error("P2\n9 9\n9\n1 2"), "a.pgm:3: is truncated: 12 bytes cannot hold 9 by 9 pixels");
  EXPECT_THAT(error("P5\n1 1\n9\nz"), HasSubstr("has a value above the maximum 9"));
  EXPECT_THAT(error("P5\n99999 99999\n255\n"),
              StartsWith("a.pgm: the image has 99999 by 99999 pixels, expected at most"));
}

TEST(GdalImage, PngOfEveryKindOfSampleIsRead) {
  const ScratchFolder folder;
  const auto file = folder.file("a.png");
  write_gdal(file, "PNG", GDT_Byte, 2, 2, 1, {0, 7, 255, 130});
  EXPECT_EQ(load(file).samples, (std::vector<int>{0, 7, 255, 130}));

  write_gdal(file, "PNG", GDT_UInt16, 2, 1, 1, {513, 65535});
  const Image deep = load(file);
  EXPECT_EQ(deep.samples, (std::vector<int>{513, 65535}));
  EXPECT_EQ(deep.format.max_value, 65535);

  write_gdal(file, "PNG", GDT_Byte, 1, 2, 2, {1, 2, 3, 4});
  const Image grey_alpha = load(file);
  EXPECT_EQ(grey_alpha.samples, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_TRUE(grey_alpha.format.alpha);
  EXPECT_EQ(grey_alpha.format.colours, 1);

  write_gdal(file, "PNG", GDT_Byte, 2, 1, 3, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(load(file).samples, (std::vector<int>{1, 2, 3, 4, 5, 6}));

  write_gdal(file, "PNG", GDT_Byte, 2, 1, 4, {1, 2, 3, 4, 5, 6, 7, 8});
  const Image rgba = load(file);
  EXPECT_EQ(rgba.samples, (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_TRUE(rgba.format.alpha);
}

TEST(GdalImage, PalettesArriveAsColours) {
  const ScratchFolder folder;
  const auto file = folder.file("a.png");
  GDALColorTable palette;
  const GDALColorEntry entries[] = {{10, 20, 30, 255}, {40, 50, 60, 255}, {70, 80, 90, 255}};
  for (int i = 0; i < 3; ++i) palette.SetColorEntry(i, &entries[i]);
  write_gdal(file, "PNG", GDT_Byte, 3, 1, 1, {2, 0, 1}, &palette);
  const Image image = load(file);
  EXPECT_EQ(image.format.colours, 3);
  EXPECT_FALSE(image.format.alpha);
  EXPECT_EQ(image.samples, (std::vector<int>{70, 80, 90, 10, 20, 30, 40, 50, 60}));
}

TEST(GdalImage, OneBitImagesReachWhite) {
  const ScratchFolder folder;
  for (const char* name : {"a.png", "a.tif"}) {
    const bool png = std::string(name) == "a.png";
    write_gdal(folder.file(name), png ? "PNG" : "GTiff", GDT_Byte, 3, 1, 1, {0, 1, 1}, nullptr,
               {"NBITS=1"});
    const SourceRaster raster = read_occupancy(folder.file(name), OccupancyRule{}, 100);
    EXPECT_EQ(raster.pixels, (std::vector<Pixel>{Pixel::obstacle, Pixel::free, Pixel::free}))
        << name;
  }
}

TEST(GdalImage, TiffAndBmpAreReadAndWhiteMayBeZero) {
  const ScratchFolder folder;
  write_gdal(folder.file("a.tif"), "GTiff", GDT_Byte, 2, 2, 1, {0, 7, 255, 130});
  EXPECT_EQ(load(folder.file("a.tif")).samples, (std::vector<int>{0, 7, 255, 130}));
  for (const GDALDataType type : {GDT_Byte, GDT_UInt16}) {
    const std::uint16_t dark = type == GDT_Byte ? 255 : 65535;
    write_gdal(folder.file("b.tif"), "GTiff", type, 2, 1, 1, {0, dark}, nullptr,
               {"PHOTOMETRIC=MINISWHITE"});
    EXPECT_EQ(read_occupancy(folder.file("b.tif"), OccupancyRule{}, 100).pixels,
              (std::vector<Pixel>{Pixel::free, Pixel::obstacle}));
  }
  write_gdal(folder.file("c.bmp"), "BMP", GDT_Byte, 2, 1, 3, {9, 8, 7, 6, 5, 4});
  EXPECT_EQ(load(folder.file("c.bmp")).samples, (std::vector<int>{9, 8, 7, 6, 5, 4}));
}

TEST(GdalImage, DamagedFilesAreRefusedAndNothingIsPrinted) {
  const ScratchFolder folder;
  const auto file = folder.file("a.png");
  Random random(3);
  std::vector<std::uint16_t> noise;
  for (int i = 0; i < 64 * 64; ++i) noise.push_back(static_cast<std::uint16_t>(random.below(256)));
  write_gdal(file, "PNG", GDT_Byte, 64, 64, 1, noise);
  std::ifstream stream(file, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  for (const std::size_t keep :
       {std::size_t{8}, std::size_t{20}, std::size_t{60}, whole.size() / 2}) {
    const auto cut = folder.write("cut.png", whole.substr(0, keep));
    EXPECT_THAT(input_error_of([&] { (void)load(cut); }), StartsWith("cut.png: cannot be "));
  }
  EXPECT_THAT(input_error_of([&] { (void)load(folder.write("x.tif", "II*\0nonsense")); }),
              StartsWith("x.tif: cannot be opened as TIFF, PNG, BMP or JPEG"));
  EXPECT_THAT(input_error_of([&] { (void)load(folder.write("x.png", "by hand")); }),
              StartsWith("x.png: cannot be opened as TIFF, PNG, BMP or JPEG: `x.png' not recogni"));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(GdalImage, LargeImagesAreRefusedUnread) {
  const ScratchFolder folder;
  write_gdal(folder.file("a.png"), "PNG", GDT_Byte, 50, 50, 1, std::vector<std::uint16_t>(2500));
  EXPECT_EQ(input_error_of([&] { (void)load(folder.file("a.png"), 2499); }),
            "a.png: the image has 50 by 50 pixels, expected at most 2499 in all");
}

TEST(Occupancy, TrinaryAveragesAlphaInAndScaleTakesWhatIsNotOpaqueAsUnknown) {
  const ScratchFolder folder;
  const auto file = folder.file("a.png");
  // White and transparent: mean of 255, 255, 255, 0 is 191.25, occ 0.25: unknown in trinary.
  write_gdal(file, "PNG", GDT_Byte, 4, 1, 4,
             {255, 255, 255, 255, 255, 255, 255, 0, 0, 0, 0, 255, 0, 0, 0, 0});
  OccupancyRule rule;
  EXPECT_EQ(read_occupancy(file, rule, 100).pixels,
            (std::vector<Pixel>{Pixel::free, Pixel::unknown, Pixel::obstacle, Pixel::obstacle}));
  rule.mode = OccupancyRule::Mode::scale;
  EXPECT_EQ(read_occupancy(file, rule, 100).pixels,
            (std::vector<Pixel>{Pixel::free, Pixel::unknown, Pixel::obstacle, Pixel::unknown}));
}

TEST(Occupancy, WhatTheAlphaChannelMakesOfPixelsIsWarnedAbout) {
  const ScratchFolder folder;
  const auto file = folder.file("a.png");
  const auto warnings = [&](int bands, const std::vector<std::uint16_t>& samples,
                            const OccupancyRule& rule) {
    const int width = static_cast<int>(samples.size()) / bands;
    write_gdal(file, "PNG", GDT_Byte, width, 1, bands, samples);
    return read_occupancy(file, rule, 100).warnings;
  };
  // Free colours, but opaque and negated: (3 * 0 + 255) / 4 is 0.25, above both thresholds.
  const OccupancyRule negated{OccupancyRule::Mode::trinary, 0.2, 0.1, true};
  EXPECT_THAT(warnings(4, {0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255}, negated),
              ::testing::ElementsAre(::testing::AllOf(
                  StartsWith(file.string() + ": the alpha channel"), HasSubstr("negate"),
                  HasSubstr("makes 2 pixels obstacles where the colours alone would not"))));
  // White, transparent: grey and alpha have occ 1/2.
  EXPECT_THAT(warnings(2, {255, 0, 255, 255}, {OccupancyRule::Mode::trinary, 0.4, 0.1, false}),
              ::testing::ElementsAre(HasSubstr("makes 1 pixels obstacles")));
  EXPECT_THAT(warnings(2, {255, 0, 255, 0}, OccupancyRule{}),
              ::testing::ElementsAre(HasSubstr("makes 2 pixels unknown (by default obstacles)")));
  EXPECT_THAT(warnings(4, {255, 255, 255, 255, 0, 0, 0, 255}, OccupancyRule{}),
              ::testing::IsEmpty());
  OccupancyRule scale;
  scale.mode = OccupancyRule::Mode::scale;
  EXPECT_THAT(warnings(2, {255, 0, 255, 255}, scale),
              ::testing::ElementsAre(HasSubstr("1 pixels are not opaque (alpha channel)")));
}

TEST(Occupancy, DeepImagesAreReadLikeShallowOnesOfTheSameShade) {
  const ScratchFolder folder;
  std::string shallow = "P5 256 1 255\n";
  std::string deep = "P5 256 1 65535\n";
  for (int grey = 0; grey < 256; ++grey) {
    shallow += static_cast<char>(grey);
    deep += static_cast<char>(grey);  // 257 * grey
    deep += static_cast<char>(grey);
  }
  const auto a = folder.write("a.pgm", shallow);
  const auto b = folder.write("b.pgm", deep);
  for (const auto mode : {OccupancyRule::Mode::trinary, OccupancyRule::Mode::scale})
    EXPECT_EQ(read_occupancy(a, {mode, 0.65, 0.196, false}, 1000).pixels,
              read_occupancy(b, {mode, 0.65, 0.196, false}, 1000).pixels);
}

std::filesystem::path write_empty_tiff(const std::filesystem::path& file, int side, int tile) {
  GDALRegister_GTiff();
  auto* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const std::string width = "BLOCKXSIZE=" + std::to_string(tile);
  const std::string height = "BLOCKYSIZE=" + std::to_string(tile);
  const char* options[] = {"TILED=YES", "SPARSE_OK=TRUE", width.c_str(), height.c_str(), nullptr};
  const auto dataset = std::unique_ptr<GDALDataset>(
      driver->Create(file.string().c_str(), side, side, 1, GDT_Byte, const_cast<char**>(options)));
  EXPECT_NE(dataset, nullptr);
  return file;
}

// A tile of 32768 x 32768 pixels takes a gigabyte, for an image of 100 x 100.
TEST(GdalImages, BlocksFarLargerThanTheImageAreRefusedUnread) {
  const ScratchFolder folder;
  const auto file = write_empty_tiff(folder.file("bomb.tif"), 100, 32768);
  EXPECT_EQ(input_error_of([&] { (void)load(file); }),
            "bomb.tif: is stored in blocks of 32768 x 32768 pixels for an image of 100 x 100, "
            "expected no more than the image, or 2^24 pixels; gdal_translate makes a copy with "
            "others");
  const Image fine = load(write_empty_tiff(folder.file("fine.tif"), 100, 4096));
  EXPECT_EQ(fine.samples.size(), 10000U);
}

}  // namespace
}  // namespace fairway
