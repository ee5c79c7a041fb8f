#include "fairway/base/parallel.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace fairway {
namespace {

TEST(ParallelRanges, CoverEveryIndexOnce) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{15}, std::size_t{16},
                                  std::size_t{17}, std::size_t{100000}}) {
    for (const std::size_t grain : {std::size_t{0}, std::size_t{1}, std::size_t{64}}) {
      std::vector<int> visits(count, 0);
      for_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1));
    }
  }
}

TEST(ParallelRanges, NoRowsAreNoCalls) {
  for_rows(0, [](int, int) { FAIL(); });
  for_rows(-3, [](int, int) { FAIL(); });
}

}  // namespace
}  // namespace fairway
