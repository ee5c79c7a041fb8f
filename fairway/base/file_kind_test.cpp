#include "fairway/base/file_kind.hpp"

#include <string>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "fairway/base/safetensors.hpp"

namespace fairway {
namespace {

FileKind kind_of(std::string_view text) { return kind_of_bytes(std::as_bytes(std::span(text))); }

std::string product(const std::string& record) {
  return safetensors_header({{{"fairway", record}}, {}});
}

TEST(FileKind, IsDetectedFromTheContent) {
  const std::pair<std::string, FileKind> files[] = {
      {"# mine\n[map]\nfile = \"a.yaml\"\n[mission]\nkind = \"goal\"\n", FileKind::scenario},
      {"\xef\xbb\xbf[map]\r\nfile = \"a.yaml\"\r\n[mission]\r\n", FileKind::scenario},
      {"image: a.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n", FileKind::ros_map},
      {product("{\"format_version\":1}"), FileKind::plan},
      {product("{\"format\":\"fairway-certificate\"}"), FileKind::certificate},
      {product("{\"format\":\"fairway-contract-certificate\"}"), FileKind::contract_certificate},
      {"type octile\nheight 1\nwidth 1\nmap\n.\n", FileKind::moving_ai},
      {"{\"fileType\": \"Plan\"}", FileKind::qgc_plan},
      {"{\"type\": \"Point\", \"coordinates\": [8, 47]}", FileKind::geojson},
      {"QGC WPL 110\n", FileKind::waypoints},
      {"P5\n1 1\n255\nx", FileKind::image},
      {"x_m,y_m\n0,0\n", FileKind::unknown},
      {product("{\"format\":\"another\"}"), FileKind::unknown},
      {product("{\"format\":\"fairway-bitmap\"}"), FileKind::bitmap},
      {"", FileKind::unknown},
      {"\n", FileKind::unknown},
      {"{\"a\": 1}", FileKind::unknown},
      {"\xff\xfe[\0m\0", FileKind::unknown}};
  for (const auto& [text, kind] : files)
    EXPECT_EQ(static_cast<int>(kind_of(text)), static_cast<int>(kind)) << text;
}

TEST(FileKind, WordsSayWhatToDoWithTheOtherKind) {
  EXPECT_EQ(other_kind_words(FileKind::scenario, FileKind::plan),
            "is a scenario: `fairway plan` makes a plan from it");
  EXPECT_EQ(other_kind_words(FileKind::plan, FileKind::certificate),
            "is a plan: `fairway verify` makes its certificate");
  EXPECT_EQ(other_kind_words(FileKind::plan, FileKind::bitmap),
            "is a plan: `fairway verify --method bitmap` draws its bitmap");
  EXPECT_EQ(other_kind_words(FileKind::bitmap, FileKind::certificate),
            "is a bitmap, a picture drawn from samples, not a proof: `fairway verify` without "
            "--method bitmap makes a certificate");
  EXPECT_EQ(other_kind_words(FileKind::ros_map, FileKind::scenario),
            "is a ROS map: name it in a scenario, as map.file");
  EXPECT_EQ(other_kind_words(FileKind::certificate, FileKind::plan),
            "is a certificate, expected a plan: use it with `fairway query`");
  EXPECT_EQ(other_kind_words(FileKind::plan, FileKind::plan), "");
  EXPECT_EQ(other_kind_words(FileKind::unknown, FileKind::plan), "");
}

}  // namespace
}  // namespace fairway
