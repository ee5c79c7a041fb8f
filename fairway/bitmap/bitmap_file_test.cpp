#include "fairway/bitmap/bitmap_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/bitmap/testing/sample_bitmaps.hpp"

namespace fairway {
namespace {

using nlohmann::json;

std::string written(const Bitmap& bitmap) {
  const auto path = std::filesystem::path(testing::TempDir()) / "b.safetensors";
  write_bitmap(bitmap, path, Existing::replace);
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Bitmap read(const std::string& bytes) {
  std::vector<std::uint64_t> words((bytes.size() + 7) / 8);  // aligned
  std::memcpy(words.data(), bytes.data(), bytes.size());
  return bitmap_of_bytes(std::as_bytes(std::span(words)).first(bytes.size()), "b");
}

std::string refusal(const std::string& bytes) {
  try {
    (void)read(bytes);
    return "read";
  } catch (const InputError& error) {
    return error.what();
  }
}

Bitmap sample(const RegionOfInterest& interest = {}, int samples = 12) {
  Random random(3);
  Bitmap bitmap = bitmap_of(swirled_plan(7, random), interest, samples);
  bitmap.frame = Frame{{1.0, 2.0, 0.25}, GeoReference{47.0, 8.0, 0.001}, {}};
  bitmap.evidence_json = R"({"program":"a test","share":0.25})";
  return bitmap;
}

TEST(BitmapFile, ReadsBackAsItWasWritten) {
  RegionOfInterest box{RegionOfInterest::Kind::rectangle, {-35.0, 12.0, 0.0, 40.0}, {}};
  RegionOfInterest cells{RegionOfInterest::Kind::cells, {}, std::vector<std::uint8_t>(70)};
  cells.cells[11] = 1;
  for (const RegionOfInterest& interest :
       {RegionOfInterest{}, RegionOfInterest{RegionOfInterest::Kind::obstacle, {}, {}}, box,
        cells}) {
    const Bitmap bitmap = sample(interest);
    const std::string bytes = written(bitmap);
    const Bitmap back = read(bytes);
    EXPECT_EQ(back.set, bitmap.set);
    EXPECT_EQ(back.vehicle.turn_radius_m, bitmap.vehicle.turn_radius_m);
    EXPECT_EQ(back.region, bitmap.region);
    EXPECT_EQ(back.kind, bitmap.kind);
    EXPECT_EQ(back.region_of_interest.kind, interest.kind);
    EXPECT_EQ(back.region_of_interest.rectangle_m, interest.rectangle_m);
    EXPECT_EQ(back.plan, bitmap.plan);
    EXPECT_EQ(back.frame, bitmap.frame);
    EXPECT_EQ(json::parse(record_text(back)), json::parse(record_text(bitmap)));
    EXPECT_EQ(written(back), bytes);
  }
}

TEST(BitmapFile, OfAGridOfOneCellHasNoBorders) {
  Bitmap one = sample();
  one.set = BorderBitmap{{1, 1, 0.0, 0.0, 8.0}, 4, {}};
  one.heading_rad.resize(1);
  one.region.assign(1, Region::free);
  one.kind.assign(1, CellKind::ordinary);
  one.plan.heading_rad = sha256_hex(std::as_bytes(std::span(one.heading_rad)));
  one.plan.region = sha256_hex(std::as_bytes(std::span(one.region)));
  EXPECT_EQ(read(written(one)).set, one.set);
}

/// The file with its record changed, the header's length with it.
std::string with_record(const std::string& bytes, const std::function<void(json&)>& change) {
  std::vector<std::uint64_t> words((bytes.size() + 7) / 8);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  Safetensors file = parse_safetensors(std::as_bytes(std::span(words)).first(bytes.size()), "b");
  json record = json::parse(file.metadata["fairway"]);
  change(record);
  file.metadata["fairway"] = record.dump();
  std::string changed = safetensors_header(file);
  for (const Tensor& tensor : file.tensors)
    changed.append(reinterpret_cast<const char*>(tensor.data.data()), tensor.data.size());
  return changed;
}

TEST(BitmapFile, IsReadStrictly) {
  const std::string good = written(sample());
  ASSERT_EQ(refusal(good), "read");
  using testing::HasSubstr;
  const auto refused = [&](const std::function<void(json&)>& change, const char* what) {
    EXPECT_THAT(refusal(with_record(good, change)), HasSubstr(what));
  };
  ASSERT_EQ(refusal(with_record(good, [](json&) {})), "read");
  refused([](json& r) { r["format"] = "fairway-certificate"; }, "not a bitmap");
  refused([](json& r) { r["format_version"] = 1; }, "draw the bitmap again");
  refused([](json& r) { r["samples_per_border"] = 14; }, "multiple of four");
  refused([](json& r) { r["samples_per_border"] = -4; }, "multiple of four");
  refused([](json& r) { r["samples_per_border"] = 16; }, "border_words");
  refused([](json& r) { r["samples_per_border"] = 12.5; }, "multiple of four");
  refused([](json& r) { r["cell_m"] = 1e9; }, "sizes in the range");
  refused([](json& r) { r["cell_m"] = "8"; }, "cell_m");
  refused([](json& r) { r["origin_m"] = {0.0, 1e300}; }, "sizes in the range");
  refused([](json& r) { r["vehicle"]["turn_radius_m"] = 1.0; }, "sizes in the range");
  refused([](json& r) { r["region_of_interest"] = "somewhere"; }, "region_of_interest");
  refused([](json& r) { r["region_of_interest"] = "obstacle"; }, "cell_kind");
  refused([](json& r) { r["plan_sha256"]["region"] = std::string(64, '0'); }, "plan_sha256");
  refused([](json& r) { r["sha256"]["border_words"] = std::string(64, '0'); }, "damaged");
  refused([](json& r) { r["frame"] = 1; }, "frame");
  for (const char* key : {"format", "format_version", "samples_per_border", "cell_m", "origin_m",
                          "vehicle", "region_of_interest", "plan_sha256", "sha256"}) {
    refused([key](json& r) { r.erase(key); }, key);
  }
}

TEST(BitmapFile, WithAnyByteOfItsArraysChangedIsRefused) {
  const std::string good = written(sample({}, 4));
  std::size_t at = 8;
  for (std::size_t i = 0; i < 8; ++i)
    at += std::size_t{static_cast<unsigned char>(good[i])} << (8 * i);
  for (; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 1);
    EXPECT_NE(refusal(bad), "read") << at;
  }
  EXPECT_NE(refusal(good + "x"), "read");
  EXPECT_NE(refusal(good.substr(0, good.size() - 1)), "read");
}

TEST(BitmapFile, HasNoBitsAfterTheLastSampleOfABorder) {
  Bitmap bitmap = sample({}, 12);  // 144 bits in three words
  bitmap.set.words[2] |= std::uint64_t{1} << 16;
  EXPECT_THAT(refusal(written(bitmap)), testing::HasSubstr("after the last sample"));
}

TEST(BitmapFile, AcceptsOnlyHeadingsAsCommands) {
  Bitmap bitmap = sample();
  bitmap.heading_rad[3] = 4.0F;
  bitmap.plan.heading_rad = sha256_hex(std::as_bytes(std::span(bitmap.heading_rad)));
  EXPECT_THAT(refusal(written(bitmap)), testing::HasSubstr("heading_rad"));
}

}  // namespace
}  // namespace fairway
