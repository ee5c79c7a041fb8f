#include "fairway/base/loaded_file.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

class LoadedFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "/loaded-XXXXXX";
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file_of(const std::string& text) const {
    std::ofstream(folder_ / "a", std::ios::binary) << text;
    return folder_ / "a";
  }
  static std::string text_of(const LoadedFile& file) {
    return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
  }

  fs::path folder_;
};

TEST_F(LoadedFiles, KeepTheContentWhateverHappensToTheFile) {
  for (const std::size_t size : {0U, 1U, 7U, 8U, 9U, 100'000U}) {
    std::string text(size, '\0');
    for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>(i % 251);
    const fs::path path = file_of(text);
    const LoadedFile file(path);
    fs::resize_file(path, 0);
    EXPECT_EQ(text_of(file), text);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(file.bytes().data()) % 8, 0U);
  }
}

TEST_F(LoadedFiles, AnythingButARegularFileIsRefusedByName) {
  for (const fs::path& path : {folder_ / "none", folder_, fs::path("/dev/zero")}) {
    try {
      const LoadedFile file(path);
      FAIL() << path;
    } catch (const InputError& error) {
      EXPECT_EQ(error.where(), path.string());
    }
  }
}

}  // namespace
}  // namespace fairway
