// Every input of the corpus, including what the fuzzers have found, gives a map, a path or an
// InputError with a location and a reason; and nothing is printed.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fuzz/read_bytes.hpp"

namespace fairway {
namespace {

std::vector<std::filesystem::path> corpus_of(std::string_view reader) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(FAIRWAY_SOURCE_DIR) / "fuzz" / "corpus" / reader))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Corpus : public ::testing::TestWithParam<std::string_view> {};

TEST_P(Corpus, GivesAValueOrAnInputErrorAndPrintsNothing) {
  int read = 0;
  int refused = 0;
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  for (const auto& file : corpus_of(GetParam())) {
    std::string answer;
    EXPECT_NO_THROW(answer = feed(GetParam(), bytes_of(file))) << file;
    // A message says where, then what.
    EXPECT_TRUE(answer == "read" || answer.find(": ") != std::string::npos) << file << answer;
    ++(answer == "read" ? read : refused);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_GT(read, 0) << "the corpus should hold a good input";
  EXPECT_GT(refused, 0) << "and a bad one";
}

TEST_P(Corpus, EveryBeginningOfAGoodInputGivesAValueOrAnInputError) {
  for (const auto& file : corpus_of(GetParam())) {
    const std::string whole = bytes_of(file);
    for (std::size_t keep = 0; keep < whole.size(); keep += 1 + whole.size() / 12)
      EXPECT_NO_THROW(feed(GetParam(), std::string_view(whole).substr(0, keep)))
          << file << " cut to " << keep;
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, Corpus,
                         ::testing::ValuesIn(readers_to_feed().begin(), readers_to_feed().end()),
                         [](const auto& entry) { return std::string(entry.param); });

}  // namespace
}  // namespace fairway
