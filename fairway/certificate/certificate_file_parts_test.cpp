#include "fairway/certificate/certificate_file_parts.hpp"

#include <gtest/gtest.h>

namespace fairway {
namespace {

TEST(LeavesInOrder, BeginAtTheStartOfTheirSectionAndAscend) {
  EXPECT_TRUE(leaves_are_in_order({0}, {}));
  EXPECT_TRUE(leaves_are_in_order({0, 0, 0}, {}));
  EXPECT_TRUE(leaves_are_in_order({0, 2, 2, 3}, {0, 7, 0}));
  EXPECT_FALSE(leaves_are_in_order({0, 2, 2, 3}, {0, 0, 0}));
  EXPECT_FALSE(leaves_are_in_order({0, 2, 2, 3}, {0, 7, 1}));
  EXPECT_FALSE(leaves_are_in_order({1, 2, 2, 3}, {0, 7, 0}));
  EXPECT_FALSE(leaves_are_in_order({0, 2, 1, 3}, {0, 7, 0}));
}

TEST(LeavesInOrder, NothingBeyondTheLeavesIsRead) {
  // A section that claims more leaves than there are, before one that ends where they do; run with
  // the address sanitizer to see it fail.
  EXPECT_FALSE(leaves_are_in_order({0, 4000000000U, 2}, {0, 7}));
  EXPECT_FALSE(leaves_are_in_order({0, 4000000000U, 4000000001U, 2}, {0, 7}));
}

}  // namespace
}  // namespace fairway
