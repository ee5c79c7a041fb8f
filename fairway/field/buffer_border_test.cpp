#include "fairway/field/buffer_border.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "fairway/field/distance_transform.hpp"
#include "fairway/field/testing/sample_maps.hpp"

namespace fairway {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

struct Scene {
  Grid grid;
  std::vector<Region> region;
  std::vector<float> cost;
};

// Random regions and costs: the border depends on nothing else.
Scene random_scene(Random& random, int nx, int ny) {
  Scene s{{nx, ny, 0.0, 0.0, 1.0}, {}, {}};
  for (std::size_t i = 0; i < s.grid.size(); ++i) {
    const double draw = random.unit();
    s.region.push_back(draw < 0.15   ? Region::obstacle
                       : draw < 0.4  ? Region::buffer
                       : draw < 0.95 ? Region::free
                                     : Region::goal);
    const bool safe = s.region.back() == Region::free || s.region.back() == Region::goal;
    s.cost.push_back(safe && random.unit() < 0.3 ? static_cast<float>(i) : inf);
  }
  return s;
}

std::vector<std::uint32_t> border_cells(const Scene& s) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < s.grid.size(); ++i) {
    const Cell c = s.grid.cell_at(i);
    bool touches = false;
    for (int k = 0; k < 9; ++k) {
      const Cell n{c.ix + k % 3 - 1, c.iy + k / 3 - 1};
      touches = touches || (s.grid.contains(n) && s.region[s.grid.index(n)] == Region::buffer);
    }
    if (touches && std::isfinite(s.cost[i])) out.push_back(i);
  }
  return out;
}

TEST(BufferBorderCells, TheNearestReachableOneIsFoundFromEveryCell) {
  Random random(91);
  for (const auto& [nx, ny] :
       std::vector<std::pair<int, int>>{{1, 1}, {1, 20}, {20, 1}, {13, 17}, {40, 30}}) {
    for (int draw = 0; draw < 10; ++draw) {
      const Scene s = random_scene(random, nx, ny);
      const BufferBorder found = buffer_border(s.grid, s.region, s.cost);
      const std::vector<std::uint32_t> border = border_cells(s);
      ASSERT_EQ(found.nearest.size(), s.grid.size());
      for (std::size_t i = 0; i < s.grid.size(); ++i) {
        const auto distance = [&](std::uint32_t b) {
          return norm(s.grid.center(s.grid.cell_at(b)) - s.grid.center(s.grid.cell_at(i)));
        };
        double least = std::numeric_limits<double>::infinity();
        bool listed = false;
        for (const std::uint32_t b : border) {
          least = std::min(least, distance(b));
          listed = listed || b == found.nearest[i];
        }
        ASSERT_EQ(listed, !border.empty());
        if (border.empty()) {
          ASSERT_EQ(found.nearest[i], no_feature);
        } else {
          ASSERT_DOUBLE_EQ(distance(found.nearest[i]), least);
        }
      }
    }
  }
}

TEST(BufferBorderCells, AWalledOffPocketIsNotAWayOut) {
  Random random(92);
  Scene s = random_scene(random, 12, 9);
  std::fill(s.region.begin(), s.region.end(), Region::buffer);
  s.region[s.grid.index({2, 4})] = Region::free;  // near, of infinite cost
  s.region[s.grid.index({11, 4})] = Region::free;
  std::fill(s.cost.begin(), s.cost.end(), inf);
  s.cost[s.grid.index({11, 4})] = 5.0F;
  for (const std::uint32_t nearest : buffer_border(s.grid, s.region, s.cost).nearest) {
    EXPECT_EQ(nearest, s.grid.index({11, 4}));
  }
}

}  // namespace
}  // namespace fairway
