// One header grammar (docs/formats.md, "Header") and three readers: the library's, the vehicle's,
// and the checker's. What one refuses, all refuse; what they accept, they read alike.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "check/tensors.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/base/tensor_header.hpp"

namespace fairway_check {
namespace {

namespace fs = std::filesystem;
using fairway::Random;
using nlohmann::json;

/// Type, shape, begin and end of every array, by name.
using Arrays =
    std::map<std::string,
             std::tuple<std::string, std::vector<std::uint64_t>, std::uint64_t, std::uint64_t>>;

std::string file_of(const std::string& header, std::size_t data_size) {
  const std::uint64_t length = header.size();
  std::string file(8, '\0');
  std::memcpy(file.data(), &length, 8);
  return file + header + std::string(data_size, '\0');
}

struct Reading {
  std::optional<Arrays> arrays;  ///< none: refused
  std::string why;
};

Reading by_library(const std::string& file, std::size_t header_size, bool with_record) {
  try {
    const auto bytes = std::as_bytes(std::span(file));
    const fairway::Safetensors content = fairway::parse_safetensors(bytes, "f");
    if (!content.metadata.contains("fairway")) return {{}, "no record"};
    if (with_record) (void)fairway::parse_strict_json(content.metadata.at("fairway"), "f");
    Arrays arrays;
    for (const fairway::Tensor& t : content.tensors) {
      const auto begin = static_cast<std::uint64_t>(t.data.data() - bytes.data()) - 8 - header_size;
      arrays[t.name] = {t.dtype, t.shape, begin, begin + t.data.size()};
    }
    return {arrays, ""};
  } catch (const fairway::InputError& error) {
    return {{}, error.what()};
  }
}

std::string resolved(const fairway::HeaderText& text) {
  return json::parse('"' + std::string(text.begin, text.end) + '"').get<std::string>();
}

Reading by_vehicle(const std::string& header, std::size_t data_size) {
  fairway::TensorHeader read;
  if (!read.read(header.data(), header.size(), data_size) || !read.has_record()) return {{}, "no"};
  Arrays arrays;
  for (int i = 0; i < read.size(); ++i) {
    const fairway::HeaderEntry& e = read[i];
    const std::string name = resolved(e.name);
    const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) { return c > 0; });
    if (is_plain) {
      EXPECT_EQ(read.find(name.c_str()), &e) << header;
    }
    arrays[name] = {resolved(e.dtype), {e.shape, e.shape + e.sizes}, e.begin, e.end};
  }
  return {arrays, ""};
}

Reading by_checker(const std::string& file, std::size_t header_size) {
  try {
    const std::span<const char> data = std::span(file).subspan(8 + header_size);
    const TensorFile read = tensors_of({file.data() + 8, header_size}, data);
    Arrays arrays;
    for (const auto& [name, t] : read.tensors) {
      const auto begin = static_cast<std::uint64_t>(t.bytes.data() - data.data());
      arrays[name] = {t.type, t.shape, begin, begin + t.bytes.size()};
    }
    return {arrays, ""};
  } catch (const Defect& defect) {
    EXPECT_EQ(defect.code, unreadable);
    return {{}, defect.what()};
  } catch (const json::exception& error) {
    return {{}, error.what()};
  }
}

/// Whether it is read; requires that all readers agree.
bool is_read(const std::string& header, std::size_t data_size) {
  const std::string file = file_of(header, data_size);
  const Reading library = by_library(file, header.size(), false);
  const Reading vehicle = by_vehicle(header, data_size);
  EXPECT_EQ(library.arrays, vehicle.arrays) << header << "\nlibrary: " << library.why;
  const Reading whole = by_library(file, header.size(), true);
  const Reading checker = by_checker(file, header.size());
  EXPECT_EQ(whole.arrays, checker.arrays)
      << header << "\nlibrary: " << whole.why << "\nchecker: " << checker.why;
  return library.arrays.has_value();
}

constexpr const char* good =
    R"({"__metadata__":{"fairway":"{\"a\":1}"},"a":{"dtype":"F32","shape":[2,3],"data_offsets":[0,24]},)"
    R"("b":{"dtype":"I8","shape":[5],"data_offsets":[24,29]}})";
constexpr std::size_t good_size = 29;

/// As Python writes it, with an extra key, arrays in another order, and two empty ones.
constexpr const char* spaced =
    "{\"b\": {\"shape\": [5], \"data_offsets\": [24, 29], \"dtype\": \"I8\"}, \n\t\"none\": "
    "{\"dtype\": \"U8\", \"shape\": [0], \"data_offsets\": [24, 24]}, \"nor\": {\"dtype\": "
    "\"F64\", "
    "\"shape\": [3, 0], \"data_offsets\": [29, 29]}, \"__metadata__\": {\"x\": \"\\u00e9\\n\", "
    "\"fairway\": \"{\\\"a\\\": [1, 2.5e3]}\"}, \"a\": {\"dtype\": \"F32\", \"shape\": [2, 3], "
    "\"data_offsets\": [0, 24]}}   ";

std::string with(const std::string& was, const std::string& is) {
  std::string text = good;
  const std::size_t at = text.find(was);
  EXPECT_NE(at, std::string::npos) << was;
  return text.replace(at, was.size(), is);
}

TEST(Headers, OfEveryOrderAndSpacingAreReadAlike) {
  EXPECT_TRUE(is_read(good, good_size));
  EXPECT_TRUE(is_read(spaced, good_size));
  EXPECT_TRUE(is_read(std::string(good) + " \t\r\n", good_size));
  EXPECT_TRUE(is_read(with("\"b\"", "\"\\u0062\""), good_size));
  EXPECT_TRUE(is_read(with("\"b\"", "\"\\u00e9\""), good_size));
  EXPECT_TRUE(is_read(with("\"b\"", "\"\\ud83d\\ude00\""), good_size));
  EXPECT_TRUE(is_read(with("\"b\"", "\"\\/\\b\\f\\\\\\\"\""), good_size));
  EXPECT_TRUE(is_read(with("\"b\"", "\"\""), good_size));
  EXPECT_TRUE(is_read(with("\"dtype\"", "\"d\\u0074ype\""), good_size));
  EXPECT_TRUE(is_read(with("\"I8\"", "\"\\u0049\\u0038\""), good_size));
  EXPECT_TRUE(is_read(with("[5]", "[1,1,1,1,1,1,1,5]"), good_size));
}

TEST(Headers, WhatTwoReadersMightReadInTwoWaysIsRefused) {
  const std::string b = R"("b":{"dtype":"I8","shape":[5],"data_offsets":[24,29]})";
  const std::vector<std::string> bad{
      with("\"__metadata__\"", b + ",\"__metadata__\""),  // a name twice
      with("\"b\"", "\"a\""),
      with("\"b\"", "\"\\u0061\""),
      with("{\"fairway\"", "{" + b + ",\"fairway\""),  // and in other places
      with("{\"dtype\":\"I8\"", "{\"x\":{" + b + "},\"dtype\":\"I8\""),
      with("{\"fairway\":", "{\"fairway\":\"{}\",\"fairway\":"),
      with("{\"fairway\":", "{\"fairway\":\"{}\",\"f\\u0061irway\":"),
      with("\"dtype\":\"I8\"", "\"dtype\":\"I8\",\"dtype\":\"I8\""),
      with("\"dtype\":\"I8\"", "\"dtype\":\"I8\",\"dtyp\\u0065\":\"I8\""),
      with("\"dtype\":\"I8\"", "\"dtype\":\"I8\",\"more\":1"),
      with("\"dtype\":\"I8\",", ""),
      with("\"shape\":[5],", ""),
      with("{\"fairway\":", "{\"x\":1,\"fairway\":"),
      with("{\"fairway\":", "{\"x\":null,\"fairway\":"),
      with("{\"fairway\":\"{\\\"a\\\":1}\"}", "3"),
      with("{\"fairway\":\"{\\\"a\\\":1}\"}", "{}"),
      with("\"__metadata__\":{\"fairway\":\"{\\\"a\\\":1}\"},", ""),
      with("\"__metadata__\"", "\"__metadata__\":{\"fairway\":\"{}\"},\"__metadata__\""),
      with("[5]", "[5.0]"),
      with("[5]", "[5e0]"),
      with("[5]", "[05]"),
      with("[5]", "[+5]"),
      with("[5]", "[-5]"),
      with("[5]", "[-0]"),
      with("[5]", "[true]"),
      with("[5]", "[\"5\"]"),
      with("[5]", "[5,]"),
      with("[5]", "[,5]"),
      with("[5]", "5"),
      with("[5]", "{\"0\":5}"),
      with("[5]", "[[5]]"),
      with("[5]", "[18446744073709551621]"),
      with("[5]", "[4294967296,4294967296,5]"),
      with("[5]", "[1,1,1,1,1,1,1,1,5]"),
      with("[24,29]", "[24.9,29.9]"),
      with("[24,29]", "[24,29,30]"),
      with("[24,29]", "[24]"),
      with("[24,29]", "[29,24]"),
      with("[24,29]", "[23,28]"),
      with("[24,29]", "[0,5]"),
      with("[24,29]", "[25,30]"),
      with("[24,29]", "[18446744073709551611,0]"),
      with("\"I8\"", "\"i8\""),
      with("\"I8\"", "\"I8 \""),
      with("\"I8\"", "\"I8\\u0000\""),
      with("\"I8\"", "8"),
      with("\"b\"", "b"),
      with("\"b\"", "\"b\tb\""),
      with("\"b\"", "\"b\x7f\""),
      with("\"b\"", "\"\xc3\xa9\""),
      with("\"b\"", "\"\\x\""),
      with("\"b\"", "\"\\u12g4\""),
      with("\"b\"", "\"\\ud83d\""),
      with("\"b\"", "\"\\ud83d\\u0041\""),
      with("\"b\"", "\"\\ude00\""),
      with(",\"b\"", ",,\"b\""),
      with(",\"b\"", ";\"b\""),
      with(",\"b\"", ",/**/\"b\""),
      " " + std::string(good),
      "\xef\xbb\xbf" + std::string(good),
      std::string(good) + "x",
      std::string(good) + "{}",
      std::string(good) + std::string(1, '\0'),
      std::string(good).substr(0, std::strlen(good) - 1),
      "",
      "{}",
      "[]",
      "{" + std::string(300000, '['),
      "{\"a\":" + std::string(300000, '[') + std::string(300000, ']') + "}"};
  for (const std::string& header : bad) EXPECT_FALSE(is_read(header, good_size)) << header;
  for (const std::size_t size : {0, 28, 30}) EXPECT_FALSE(is_read(good, size));
}

TEST(Headers, HaveNoMoreThan32MembersAndManyAreRefusedAtOnce) {
  const auto many = [](int members, bool in_metadata) {
    std::string text = "{\"__metadata__\":{\"fairway\":\"{}\"";
    for (int i = 0; in_metadata && i < members; ++i) text += fmt::format(",\"m{}\":\"\"", i);
    text += "}";
    for (int i = 0; !in_metadata && i < members; ++i) {
      text += fmt::format(",\"m{}\":{{\"dtype\":\"U8\",\"shape\":[0],\"data_offsets\":[0,0]}}", i);
    }
    return text + "}";
  };
  for (const bool in_metadata : {false, true}) {
    EXPECT_TRUE(is_read(many(31, in_metadata), 0));
    EXPECT_FALSE(is_read(many(32, in_metadata), 0));
    EXPECT_FALSE(is_read(many(40000, in_metadata), 0));
  }
}

TEST(Headers, ChangedAtRandomAreReadAlikeOrRefusedByAll) {
  std::vector<std::pair<std::string, std::size_t>> seeds{{good, good_size}, {spaced, good_size}};
  const fs::path corpus = fs::path(FAIRWAY_SOURCE_DIR) / "fuzz" / "corpus" / "plan_file";
  for (const auto& entry : fs::directory_iterator(corpus)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string file{std::istreambuf_iterator<char>(in), {}};
    std::uint64_t length = 0;
    if (file.size() < 8) continue;
    std::memcpy(&length, file.data(), 8);
    if (length > file.size() - 8) continue;
    seeds.emplace_back(file.substr(8, length), file.size() - 8 - length);
    is_read(seeds.back().first, seeds.back().second);
  }
  ASSERT_GT(seeds.size(), 5U);
  constexpr std::string_view marks = "{}[]\",:\\0123456789.eE+-udD8F \t\n\r\x7f\xc3\xa9";
  Random random(20);
  int read = 0;
  const auto somewhere = [&](const std::string& text) { return random.below(text.size() + 1); };
  for (int trial = 0; trial < 30000; ++trial) {
    auto [text, size] = seeds[trial % 3 == 0 ? random.below(seeds.size()) : random.below(2)];
    const auto changes = 1 + random.below(3);
    for (std::uint64_t k = 0; k < changes && !text.empty(); ++k) {
      const std::size_t at = somewhere(text);
      const std::size_t span = 1 + random.below(random.below(4) == 0 ? 60 : 4);
      switch (random.below(5)) {
        case 0:  // another character
          if (at < text.size()) text[at] = marks[random.below(marks.size())];
          break;
        case 1:
          text.insert(at, 1, marks[random.below(marks.size())]);
          break;
        case 2:
          text.erase(at, span);
          break;
        case 3:  // a piece of it repeated
          text.insert(somewhere(text), text.substr(at, span));
          break;
        default: {  // a member repeated, or blanks
          const std::size_t comma = text.find(',', at);
          const std::size_t next = text.find(',', comma + 1);
          if (comma < next && next != std::string::npos)
            text.insert(comma, text.substr(comma, next - comma));
          text.insert(text.find_first_of(":,]}", at) == std::string::npos
                          ? text.size()
                          : text.find_first_of(":,]}", at),
                      random.below(2), ' ');
        }
      }
    }
    if (random.below(20) == 0) size += random.below(3);
    read += is_read(text, size) ? 1 : 0;
    if (HasFailure()) return;
  }
  EXPECT_GT(read, 300);
}

}  // namespace
}  // namespace fairway_check
