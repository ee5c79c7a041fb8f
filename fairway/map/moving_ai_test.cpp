#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "fairway/map/read_map.hpp"
#include "fairway/map/testing/scratch_folder.hpp"

namespace fairway {
namespace {

using ::testing::StartsWith;

class MovingAi : public ::testing::Test {
 protected:
  ObstacleMap read(const std::string& text, std::optional<double> resolution_m = 2.0) {
    MapRequest request;
    request.file = folder_.write("city.map", text);
    request.resolution_m = resolution_m;
    request.cell_m = resolution_m.value_or(1.0);
    request.outside_is_obstacle = false;
    return read_map(request);
  }
  std::string error(const std::string& text) {
    return input_error_of([&] { (void)read(text); });
  }
  ScratchFolder folder_;
};

TEST_F(MovingAi, PointsGAndSCanBeCrossedAndTheFirstRowIsTheTop) {
  const ObstacleMap map = read("type octile\nheight 2\nwidth 7\nmap\n.GS@OTW\n@......\n");
  EXPECT_EQ(map.grid, (Grid{7, 2, 0.0, 0.0, 2.0}));
  EXPECT_EQ(map.obstacle, (std::vector<std::uint8_t>{1, 0, 0, 0, 0, 0, 0,  //
                                                     0, 0, 0, 1, 1, 1, 1}));
}

TEST_F(MovingAi, LineEndsOfAnyKindGiveTheSameMap) {
  const std::string unix_text = "type octile\nheight 2\nwidth 3\nmap\n.@.\n@..";
  std::string dos_text;
  for (const char c : unix_text) dos_text += c == '\n' ? "\r\n" : std::string(1, c);
  const auto expected = read(unix_text).obstacle;
  EXPECT_EQ(read(dos_text).obstacle, expected);
  EXPECT_EQ(read(unix_text + "\n").obstacle, expected);
  EXPECT_EQ(read(dos_text + "\r\n\r\n").obstacle, expected);
  EXPECT_EQ(read("type octile\nwidth 3\nheight 2\nmap\n.@.\n@..").obstacle, expected);
}

TEST_F(MovingAi, AnyGridWrittenIsReadBack) {
  EXPECT_TRUE(rc::check([&] {
    const int nx = *rc::gen::inRange(1, 20);
    const int ny = *rc::gen::inRange(1, 20);
    const auto cells = *rc::gen::container<std::vector<std::uint8_t>>(
        static_cast<std::size_t>(nx * ny), rc::gen::element<std::uint8_t>(0, 1));
    std::string text =
        "type octile\nheight " + std::to_string(ny) + "\nwidth " + std::to_string(nx) + "\nmap\n";
    for (int iy = ny - 1; iy >= 0; --iy) {
      for (int ix = 0; ix < nx; ++ix)
        text += cells[static_cast<std::size_t>(iy * nx + ix)] != 0 ? '@' : '.';
      text += '\n';
    }
    RC_ASSERT(read(text).obstacle == cells);
  }));
}

TEST_F(MovingAi, WithoutAResolutionTheUserIsAskedForOne) {
  EXPECT_EQ(
      input_error_of([&] { (void)read("type octile\nheight 1\nwidth 1\nmap\n.\n", std::nullopt); }),
      "city.map: has no scale of its own; map.resolution_m is missing (metres per pixel)");
}

TEST_F(MovingAi, WhatIsWrongIsNamedWithItsLine) {
  EXPECT_EQ(error("type octile\nheight 2\nwidth 3\nmap\n...\n..\n"),
            "city.map:6: the row has 2 characters, expected 3 (width)");
  EXPECT_EQ(error("type octile\nheight 3\nwidth 3\nmap\n...\n...\n"),
            "city.map:6: the map has 2 rows, expected 3 (height)");
  EXPECT_EQ(error("type octile\nheight 1\nwidth 3\nmap\n.\x01.\n"),
            "city.map:5: column 2 holds byte 1, expected a printable character");
  EXPECT_EQ(error("type hexagonal\nheight 1\nwidth 3\nmap\n...\n"),
            "city.map:1: type \"hexagonal\" is unknown, expected octile");
  EXPECT_EQ(error("type octile\nheight 0\nwidth 3\nmap\n"),
            "city.map:2: \"0\" is not a size, expected a whole number from 1 to 1000000000");
  EXPECT_EQ(error("type octile\nheight nan\nwidth 3\nmap\n"),
            "city.map:2: \"nan\" is not a size, expected a whole number from 1 to 1000000000");
  EXPECT_EQ(error("type octile\nheight 1\nheight 1\nwidth 3\nmap\n...\n"),
            "city.map:3: the size occurs twice");
  EXPECT_EQ(error("type octile\nwidth 3\nmap\n...\n"),
            "city.map:3: the line \"height N\" is missing");
  EXPECT_EQ(error("height 1\nwidth 3\nmap\n...\n"),
            "city.map:3: the line \"type octile\" is missing before \"map\"");
  EXPECT_EQ(error("type octile\nheight 1\nwidth 3\n...\n"),
            "city.map:4: unexpected \"...\"; a MovingAI map starts with type, height, "
            "width and map");
  EXPECT_THAT(
      error("type octile\nheight 100000000\nwidth 100000000\nmap\n...\n"),
      StartsWith("city.map: the image has 100000000 by 100000000 pixels, expected at most"));
}

}  // namespace
}  // namespace fairway
