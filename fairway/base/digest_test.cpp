#include "fairway/base/digest.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

std::string digest_of(const std::string& text) {
  return sha256_hex(std::as_bytes(std::span(text.data(), text.size())));
}

TEST(Digest, AgreesWithThePublishedVectors) {  // FIPS 180-4, NIST's examples
  EXPECT_EQ(digest_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Digest, OfAFileIsTheDigestOfItsBytesAlsoBeyondOnePiece) {
  const auto path = std::filesystem::path(testing::TempDir()) / "digest_test.bin";
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1} << 20,
                                 (std::size_t{1} << 20) + 1, std::size_t{2500000}}) {
    std::string content(size, '\0');
    for (std::size_t i = 0; i < size; ++i) content[i] = static_cast<char>(i * 131 + i / 251);
    std::ofstream(path, std::ios::binary | std::ios::trunc) << content;
    EXPECT_EQ(sha256_file(path), digest_of(content)) << size;
  }
  std::filesystem::remove(path);
}

TEST(Digest, OfAMissingFileOrAFolderIsAnErrorThatNamesIt) {
  const std::string missing = testing::TempDir() + "/no-such-file";
  for (const std::string& path : {missing, std::string("/tmp")}) {
    try {
      (void)sha256_file(path);
      FAIL() << path;
    } catch (const InputError& error) {
      EXPECT_EQ(error.where(), path);
    }
  }
}

}  // namespace
}  // namespace fairway
