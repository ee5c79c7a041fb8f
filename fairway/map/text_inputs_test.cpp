// Every text format of maps and paths reads the same with a byte order mark, and with any of the
// three line endings.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fairway/map/read_map.hpp"
#include "fairway/map/read_path.hpp"
#include "fairway/map/testing/scratch_folder.hpp"

namespace fairway {
namespace {

std::string with_line_ends(const std::string& text, const std::string& end) {
  std::string result;
  for (const char c : text) result += c == '\n' ? end : std::string(1, c);
  return result;
}

template <typename Visit>
void for_disguises(const std::string& text, const Visit& visit) {
  for (const char* mark : {"", "\xef\xbb\xbf"})
    for (const char* end : {"\n", "\r\n", "\r"}) visit(mark + with_line_ends(text, end));
}

TEST(TextInputs, MapsReadTheSame) {
  const ScratchFolder folder;
  folder.write("image.pgm", "P2 3 2 255 0 255 255 255 255 255");
  folder.write("placed.pgm", "P2 3 2 255 0 255 255 255 255 255");
  struct Input {
    const char* name;
    const char* text;
    const char* map;  // the file to read, if it is a different one
  };
  for (const Input& input :
       {Input{"a.yaml",
              "image: image.pgm\nresolution: 2\norigin: [0, 0, 0]\nnegate: 0\n"
              "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
              nullptr},
        Input{"a.map", "type octile\nheight 2\nwidth 3\nmap\n@..\n...\n", nullptr},
        Input{"a.geojson",
              "{\"type\": \"Polygon\",\n\"coordinates\": [[[8.0, 47.0], [8.001, 47.0],\n"
              "[8.001, 47.001], [8.0, 47.0]]]}\n",
              nullptr},
        Input{"a.plan",
              "{\"fileType\": \"Plan\",\n\"geoFence\": {\"version\": 2, \"circles\": [{\n"
              "\"inclusion\": true, \"circle\": {\"center\": [47, 8], \"radius\": 60}}]}}\n",
              nullptr},
        Input{"a.fen",
              "# fence\n48.0015 9.002\n48.0 9.0\n48.0 9.004\n48.003 9.004\n48.003 9.0\n48.0 9.0\n",
              nullptr},
        Input{"a.waypoints",
              "QGC WPL 110\n0 1 0 16 0 0 0 0 47.0 8.0 0 1\n1 0 3 16 0 0 0 0 47.001 8.0 50 1\n",
              nullptr},
        Input{"placed.wld", "2\n0\n0\n-2\n1\n3\n", "placed.pgm"}}) {
    MapRequest request;
    request.file = folder.file(input.map != nullptr ? input.map : input.name);
    request.cell_m = 2.0;
    if (std::string(input.name) == "a.map") request.resolution_m = 2.0;
    folder.write(input.name, input.text);
    const ObstacleMap expected = read_map(request);
    for_disguises(input.text, [&](const std::string& text) {
      folder.write(input.name, text);
      const ObstacleMap map = read_map(request);
      EXPECT_EQ(map.grid, expected.grid) << input.name;
      EXPECT_EQ(map.obstacle, expected.obstacle) << input.name;
    });
  }
}

TEST(TextInputs, PathsReadTheSame) {
  const ScratchFolder folder;
  ObstacleMap frame;
  frame.grid = {100, 100, -500.0, -500.0, 10.0};
  for (const auto& [name, text] :
       {std::pair("p.csv", "# a path\nx_m,y_m\n0,0\n100,20\n"),
        {"q.csv", "\"x_m\";\"y_m\"\n\"0\";\"0\"\n'100';\"20\"\n"},
        {"r.csv", "\"0\",\"0\"\n\"100\",\"20\"\n"},
        {"p.geojson", "{\"type\": \"LineString\",\n\"coordinates\": [[0, 0],\n[100, 20]]}\n"}})
    for_disguises(text, [&, name = name](const std::string& disguised) {
      EXPECT_EQ(read_path(folder.write(name, disguised), frame),
                (std::vector<Vec2>{{0, 0}, {100, 20}}))
          << name;
    });
}

TEST(TextInputs, LinesKeepTheirNumbersAndUtf16IsRefused) {
  const ScratchFolder folder;
  MapRequest request;
  request.resolution_m = 1.0;
  request.file = folder.file("a.map");
  const auto error = [&](const std::string& text) {
    folder.write("a.map", text);
    return input_error_of([&] { (void)read_map(request); });
  };
  for_disguises("type octile\n\nheight 1\nwide 2\n", [&](const std::string& text) {
    EXPECT_THAT(error(text), ::testing::StartsWith("a.map:4: \"wide\" is unknown"));
  });
  EXPECT_EQ(error(std::string("\xff\xfet\0y\0", 6)), "a.map: is text in UTF-16, expected UTF-8");
}

TEST(TextInputs, AMapsSizeHasItsRangeInTheMessage) {
  const ScratchFolder folder;
  MapRequest request;
  request.resolution_m = 1.0;
  for (const char* size : {"2e9", "4000000000", "0.5", "-1", "x", "1e300"}) {
    request.file = folder.write("a.map", std::string("type octile\nheight ") + size + "\n");
    EXPECT_EQ(input_error_of([&] { (void)read_map(request); }),
              std::string("a.map:2: \"") + size +
                  "\" is not a size, expected a whole number from 1 to 1000000000");
  }
}

}  // namespace
}  // namespace fairway
