#include "bench/blob_map.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>

namespace fairway::bench {
namespace {

double obstacle_share(const ObstacleMap& map) {
  const double count = std::accumulate(map.obstacle.begin(), map.obstacle.end(), 0.0);
  return count / static_cast<double>(map.obstacle.size());
}

TEST(BlobMap, AFifthOfItsCellsAreObstaclesWhateverTheSide) {
  for (const int side : {256, 500, 1024}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      EXPECT_NEAR(obstacle_share(blob_map(side, seed)), 0.2, 0.02) << side << " seed " << seed;
    }
  }
}

TEST(BlobMap, TheSeedDecidesTheMap) {
  EXPECT_EQ(blob_map(200, 4).obstacle, blob_map(200, 4).obstacle);
  EXPECT_NE(blob_map(200, 4).obstacle, blob_map(200, 5).obstacle);
}

TEST(BlobMap, ARingOfObstaclesClosesIt) {
  const ObstacleMap map = blob_map(130, 1);
  for (int i = 0; i < 130; ++i) {
    for (const Cell c : {Cell{i, 0}, Cell{i, 129}, Cell{0, i}, Cell{129, i}}) {
      EXPECT_EQ(map.obstacle[map.grid.index(c)], 1) << c.ix << ", " << c.iy;
    }
  }
}

TEST(BlobMap, NoTwoObstaclesTouchOnlyAtACorner) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const ObstacleMap map = blob_map(400, seed);
    const auto at = [&](int ix, int iy) { return map.obstacle[map.grid.index({ix, iy})]; };
    for (int iy = 0; iy + 1 < 400; ++iy) {
      for (int ix = 0; ix + 1 < 400; ++ix) {
        const bool corner_alone = at(ix, iy) == at(ix + 1, iy + 1) &&
                                  at(ix + 1, iy) == at(ix, iy + 1) && at(ix, iy) != at(ix + 1, iy);
        ASSERT_FALSE(corner_alone) << "seed " << seed << " at " << ix << ", " << iy;
      }
    }
  }
}

TEST(BlobMap, AnOpenPlaceHasNoObstacleWithinItsClearance) {
  const ObstacleMap map = blob_map(512, 1);
  const Cell place = open_place(map, 12);
  for (int dy = -12; dy <= 12; ++dy) {
    for (int dx = -12; dx <= 12; ++dx) {
      if (dx * dx + dy * dy > 144) continue;
      EXPECT_EQ(map.obstacle[map.grid.index({place.ix + dx, place.iy + dy})], 0);
    }
  }
  EXPECT_THROW((void)open_place(map, 255), std::runtime_error);
}

}  // namespace
}  // namespace fairway::bench
