#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fairway/base/digest.hpp"
#include "fairway/base/random.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/map/testing/scratch_folder.hpp"

namespace fairway {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class RosMap : public ::testing::Test {
 protected:
  // A YAML text with some lines replaced: key, then the whole line (empty: left out).
  static std::string yaml(std::initializer_list<std::pair<std::string, std::string>> changes = {}) {
    std::vector<std::pair<std::string, std::string>> lines = {
        {"image", "image: map.pgm"},
        {"resolution", "resolution: 1"},
        {"origin", "origin: [0, 0, 0]"},
        {"negate", "negate: 0"},
        {"occupied_thresh", "occupied_thresh: 0.65"},
        {"free_thresh", "free_thresh: 0.196"}};
    for (const auto& [key, line] : changes) {
      bool known = false;
      for (auto& entry : lines)
        if (entry.first == key) {
          entry.second = line;
          known = true;
        }
      if (!known) lines.emplace_back(key, line);
    }
    std::string text;
    for (const auto& entry : lines)
      if (!entry.second.empty()) text += entry.second + "\n";
    return text;
  }

  // One row of grey pixels.
  void write_row(const std::vector<int>& greys) {
    std::string image = "P5\n" + std::to_string(greys.size()) + " 1\n255\n";
    for (const int grey : greys) image += static_cast<char>(grey);
    folder_.write("map.pgm", image);
  }

  MapRequest request() const {
    MapRequest request;
    request.file = folder_.file("map.yaml");
    request.outside_is_obstacle = false;
    return request;
  }

  ObstacleMap read(const std::string& text) {
    folder_.write("map.yaml", text);
    return read_map(request());
  }

  // Which pixels of the row block, with unknown as obstacle and as free: '.', '?', '#'.
  std::string classes(const std::string& text) {
    folder_.write("map.yaml", text);
    MapRequest strict = request();
    MapRequest lenient = request();
    lenient.unknown_is_obstacle = false;
    const ObstacleMap a = read_map(strict);
    const ObstacleMap b = read_map(lenient);
    std::string result;
    for (std::size_t i = 0; i < a.obstacle.size(); ++i)
      result += b.obstacle[i] != 0 ? '#' : a.obstacle[i] != 0 ? '?' : '.';
    return result;
  }

  std::string error(const std::string& text) {
    return input_error_of([&] { (void)read(text); });
  }

  ScratchFolder folder_;
};

TEST_F(RosMap, TrinaryThresholdsAreStrict) {
  // occ = (255 - grey) / 255; 89 gives 0.65098, 90 gives 0.64706, 205 gives 0.196078.
  write_row({0, 89, 90, 204, 205, 206, 255});
  EXPECT_EQ(classes(yaml()), "##???..");
  // Exactly at a threshold is neither: occ is 0.4 for 153, 0.2 for 204.
  write_row({152, 153, 154, 203, 204, 205});
  EXPECT_EQ(classes(yaml({{"occupied_thresh", "occupied_thresh: 0.4"},
                          {"free_thresh", "free_thresh: 0.2"}})),
            "#????.");
}

TEST_F(RosMap, NegateTurnsShadesRoundAndMayBeANumberOrAWord) {
  write_row({0, 60, 127, 200, 255});
  EXPECT_EQ(classes(yaml()), "##??.");
  for (const char* line : {"negate: 1", "negate: true", "negate: True", "negate: yes"})
    EXPECT_EQ(classes(yaml({{"negate", line}})), ".??##") << line;
  for (const char* line : {"negate: false", "negate: 0", "negate: \"0\""})
    EXPECT_EQ(classes(yaml({{"negate", line}})), "##??.") << line;
  EXPECT_EQ(error(yaml({{"negate", "negate: 2"}})),
            "map.yaml:4: negate is \"2\", expected 0, 1, true or false");
}

TEST_F(RosMap, ScaleKeepsOnlyTheSureEnds) {
  write_row({0, 1, 100, 254, 255});
  const auto text = yaml({{"mode", "mode: scale"},
                          {"occupied_thresh", "occupied_thresh: 1.0"},
                          {"free_thresh", "free_thresh: 0.0"}});
  // 254 and 1 round to 0 and 100 percent, as in the reader of ROS 2.
  EXPECT_EQ(classes(text), "##?..");
  EXPECT_THAT(read(text).warnings,
              ::testing::Contains(HasSubstr("1 pixels are neither certainly")));
}

TEST_F(RosMap, RawTakesTheValueAsPercentageAndIgnoresNegate) {
  write_row({0, 1, 99, 100, 101, 255});
  for (const char* negate : {"negate: 0", "negate: 1"})
    EXPECT_EQ(classes(yaml({{"mode", "mode: raw"}, {"negate", negate}})), ".??#??");
}

TEST_F(RosMap, AnUnknownModeIsRefusedWithItsLine) {
  write_row({0});
  EXPECT_EQ(error(yaml({{"mode", "mode: binary"}})),
            "map.yaml:7: mode is \"binary\", expected trinary, scale or raw");
}

TEST_F(RosMap, SaverGrey205ReadAsFreeIsWarnedAbout) {
  write_row({205, 205, 254, 0});
  EXPECT_THAT(read(yaml()).warnings, IsEmpty());
  const ObstacleMap map = read(yaml({{"free_thresh", "free_thresh: 0.25"}}));
  ASSERT_EQ(map.warnings.size(), 1U);
  EXPECT_THAT(map.warnings[0], AllOf(HasSubstr("2 pixels have the grey 205"), HasSubstr("0.25")));
}

TEST_F(RosMap, TrinaryAveragesAlphaInAndScaleTakesWhatIsNotOpaqueAsUnknown) {
  // Grey PNGs with alpha are in image_rows_test; here the arithmetic, with PPM without alpha.
  std::string image = "P6 2 1 255\n";
  for (const int v : {255, 0, 0, 10, 20, 30}) image += static_cast<char>(v);
  folder_.write("map.pgm", image);
  EXPECT_EQ(classes(yaml()), "##") << "occ of pure red is 2/3";
  EXPECT_EQ(classes(yaml({{"occupied_thresh", "occupied_thresh: 0.67"}})), "?#");
}

TEST_F(RosMap, TheOriginIsTheLowerLeftCornerAndTheFirstImageRowTheTop) {
  folder_.write("map.pgm",
                "P2\n# a comment\n2 3 # width and height\n255\n0 255\n255 255\n255 255\n");
  const ObstacleMap map =
      read(yaml({{"resolution", "resolution: 0.5"}, {"origin", "origin: [-3.25, 7.5, 0.0]"}}));
  EXPECT_EQ(map.grid.x0_m, -3.25);
  EXPECT_EQ(map.grid.y0_m, 7.5);
  EXPECT_EQ(map.grid.nx, 1);
  EXPECT_EQ(map.grid.ny, 2);
  EXPECT_EQ(map.obstacle, (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(map.frame.world_from_grid.yaw_rad, 0.0);
}

TEST_F(RosMap, ARotatedOriginIsHonoured) {
  write_row({0, 255});
  const ObstacleMap map = read(yaml({{"origin", "origin: [2.0, 3.0, 1.5]"}}));
  EXPECT_EQ(map.grid, (Grid{2, 1, 0.0, 0.0, 1.0}));
  EXPECT_EQ(map.frame.world_from_grid.x_m, 2.0);
  EXPECT_EQ(map.frame.world_from_grid.y_m, 3.0);
  EXPECT_EQ(map.frame.world_from_grid.yaw_rad, 1.5);
  ASSERT_EQ(map.warnings.size(), 1U);
  EXPECT_THAT(map.warnings[0], HasSubstr("rotated by 1.5 rad"));
}

TEST_F(RosMap, TheOriginMayBeABlockList) {
  write_row({0, 255});
  EXPECT_EQ(read(yaml({{"origin", "origin:\n- -1.5\n- +2e0\n- 0"}})).grid,
            (Grid{2, 1, -1.5, 2.0, 1.0}));
}

TEST_F(RosMap, InputsAreNamedWithTheirDigests) {
  write_row({0, 255});
  const ObstacleMap map = read(yaml());
  ASSERT_EQ(map.inputs.size(), 2U);
  EXPECT_EQ(map.inputs[0].path, folder_.file("map.yaml").string());
  EXPECT_EQ(map.inputs[0].sha256, sha256_file(folder_.file("map.yaml")));
  EXPECT_EQ(map.inputs[1].sha256, sha256_file(folder_.file("map.pgm")));
}

TEST_F(RosMap, EveryMissingKeyIsNamed) {
  write_row({0});
  for (const char* key :
       {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"})
    EXPECT_EQ(error(yaml({{key, ""}})), std::string("map.yaml:5: the key ") + key + " is missing");
}

TEST_F(RosMap, WrongValuesAreNamedWithTheirLine) {
  write_row({0});
  EXPECT_EQ(error(yaml({{"resolution", "resolution: fine"}})),
            "map.yaml:2: resolution is \"fine\", expected a number");
  EXPECT_EQ(error(yaml({{"resolution", "resolution: .nan"}})),
            "map.yaml:2: resolution is \".nan\", expected a finite number");
  EXPECT_EQ(error(yaml({{"resolution", "resolution: -0.05"}})),
            "map.yaml:2: resolution is -0.05, expected metres per pixel above 0");
  EXPECT_EQ(error(yaml({{"resolution", "resolution: [1]"}})),
            "map.yaml:2: resolution is not a number");
  EXPECT_EQ(error(yaml({{"origin", "origin: [0, 1e999, 0]"}})),
            "map.yaml:3: origin is \"1e999\", expected a finite number");
  EXPECT_EQ(error(yaml({{"origin", "origin: [0, 0]"}})),
            "map.yaml:3: origin is not a list of three numbers [x, y, yaw]");
  EXPECT_EQ(error(yaml({{"occupied_thresh", "occupied_thresh: 65"}})),
            "map.yaml:5: occupied_thresh is 65, expected 0 to 1");
  EXPECT_EQ(error(yaml({{"free_thresh", "free_thresh: 0.7"}})),
            "map.yaml:6: free_thresh 0.7 is not below occupied_thresh 0.65");
  EXPECT_EQ(error(yaml({{"image", "image: other.pgm"}})),
            "map.yaml:1: the image \"other.pgm\" does not exist next to this file");
}

TEST_F(RosMap, AnOriginTooFarAwayToTellCellsApartIsRefused) {
  write_row({255});
  EXPECT_EQ(
      error(yaml({{"origin", "origin: [1e300, 0, 0]"}})),
      "map.cell_m: the map's corner is at 1e+300 m: too far from 0 to distinguish cells of 1 m");
}

TEST_F(RosMap, AKeyThatOccursTwiceIsRefused) {
  write_row({0});
  EXPECT_EQ(error(yaml({{"more", "resolution: 2"}})),
            "map.yaml:7: the key \"resolution\" occurs twice, first in line 2");
}

TEST_F(RosMap, AnUnknownKeyIsWarnedAbout) {
  write_row({255});
  EXPECT_THAT(read(yaml({{"more", "colour: red"}})).warnings,
              ::testing::ElementsAre(HasSubstr("the key \"colour\" is unknown")));
}

TEST_F(RosMap, TextThatIsNotYamlIsRefusedWithItsLine) {
  write_row({0});
  EXPECT_THAT(error("image: [map.pgm\nresolution: 1\n"), StartsWith("map.yaml:2: is not YAML: "));
  EXPECT_THAT(error("- a\n- b\n"), StartsWith("map.yaml:1: is not a ROS map"));
  EXPECT_EQ(error(""), "map.yaml: is empty");
}

TEST_F(RosMap, AMapWithoutAFreeCellIsWarnedAbout) {
  write_row({0, 0});
  EXPECT_THAT(read(yaml()).warnings, ::testing::Contains(HasSubstr("no cell of the map is free")));
}

TEST_F(RosMap, TheRequestIsCheckedToo) {
  write_row({0});
  folder_.write("map.yaml", yaml());
  const auto error_with = [&](auto change) {
    MapRequest changed = request();
    change(changed);
    return input_error_of([&] { (void)read_map(changed); });
  };
  EXPECT_EQ(error_with([](MapRequest& r) { r.cell_m = 0.0; }),
            "map.cell_m: is 0, expected a finite number above 0");
  EXPECT_EQ(error_with([](MapRequest& r) { r.cell_m = std::nan(""); }),
            "map.cell_m: is nan, expected a finite number above 0");
  EXPECT_EQ(error_with([](MapRequest& r) { r.footprint_radius_m = -1.0; }),
            "map.footprint_radius_m: is -1, expected a finite number of at least 0");
  EXPECT_EQ(error_with([](MapRequest& r) { r.resolution_m = 0.5; }),
            "map.yaml: has pixels of 1 m, but map.resolution_m is 0.5; leave it out");
  EXPECT_EQ(error_with([](MapRequest& r) { r.resolution_m = 1.0; }), "no error");
  EXPECT_THAT(error_with([](MapRequest& r) { r.altitude_m = 10.0; }),
              StartsWith("map.altitude_m: does not apply to "));
  EXPECT_EQ(error_with([](MapRequest& r) { r.file += ".gone"; }), "map.yaml.gone: no such file");
  EXPECT_THAT(error_with([](MapRequest& r) { r.file = r.file.parent_path(); }),
              HasSubstr("is a folder, expected a file"));
  EXPECT_EQ(
      error_with([](MapRequest& r) { r.file = "http://example.org/map.yaml"; }),
      "http://example.org/map.yaml: is not a local file; download it first, nothing is fetched");
  EXPECT_EQ(
      error_with([](MapRequest& r) { r.file = "/vsicurl/http://example.org/map.tif"; }),
      "/vsicurl/http://example.org/map.tif: is not a local file; download it first, nothing is "
      "fetched");
}

}  // namespace
}  // namespace fairway
