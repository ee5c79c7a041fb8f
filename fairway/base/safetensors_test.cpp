#include "fairway/base/safetensors.hpp"

#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

std::span<const std::byte> bytes(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

TEST(SafetensorsLayout, IsTheOneOfTheFormatToTheByte) {
  const std::string floats("\0\0\x80\x3f\0\0\0\x40", 8);  // 1.0f, 2.0f
  const std::string codes("\x01\xff", 2);
  const Safetensors content{{{"k", "v\"1"}},
                            {{"a", "F32", {1, 2}, bytes(floats)}, {"b", "I8", {2}, bytes(codes)}}};
  const std::string header = safetensors_header(content);
  const std::string expected =
      R"({"__metadata__":{"k":"v\"1"},"a":{"dtype":"F32","shape":[1,2],"data_offsets":[0,8]},)"
      R"("b":{"dtype":"I8","shape":[2],"data_offsets":[8,10]}})";
  EXPECT_EQ(header.substr(8, expected.size()), expected);
  EXPECT_EQ(header.size() % 8, 0U);
  std::uint64_t length = 0;
  std::memcpy(&length, header.data(), 8);
  EXPECT_EQ(length, header.size() - 8);
  EXPECT_EQ(header.find_first_not_of(' ', 8 + expected.size()), std::string::npos);

  const std::string file = header + floats + codes;
  const Safetensors back = parse_safetensors(bytes(file), "f");
  EXPECT_EQ(back.metadata, content.metadata);
  ASSERT_EQ(back.tensors.size(), 2U);
  EXPECT_EQ(back.tensors[0].name, "a");
  EXPECT_EQ(back.tensors[0].shape, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(std::memcmp(back.tensors[1].data.data(), codes.data(), 2), 0);
}

TEST(SafetensorsLayout, AFileWithoutArraysIsWhole) {
  const std::string header = safetensors_header({{{"k", "v"}}, {}});
  EXPECT_TRUE(parse_safetensors(bytes(header), "f").tensors.empty());
  EXPECT_THROW((void)parse_safetensors(bytes(header + " "), "f"), InputError);
}

TEST(Safetensors, TextIsNotTakenForACutHeader) {
  const std::string text = "[map]\nfile = \"a\"\n";
  try {
    (void)parse_safetensors(std::as_bytes(std::span(text)), "s.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "s.toml: is not a safetensors file, as plans and certificates are");
  }
}

}  // namespace
}  // namespace fairway
