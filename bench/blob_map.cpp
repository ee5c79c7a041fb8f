#include "bench/blob_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"

namespace fairway::bench {
namespace {

constexpr double obstacle_share = 0.2;

// Uniform cubic B-spline weights at t in [0, 1): smooth hills from random heights.
std::array<float, 4> spline_weights(float t) {
  const float u = 1.0F - t;
  return {u * u * u / 6.0F, (3.0F * t * t * t - 6.0F * t * t + 4.0F) / 6.0F,
          (3.0F * u * u * u - 6.0F * u * u + 4.0F) / 6.0F, t * t * t / 6.0F};
}

// Random heights every `spacing` cells, and the smooth surface through them.
class Hills {
 public:
  Hills(int side, int spacing, std::uint64_t seed)
      : spacing_(spacing), columns_(side / spacing + 4) {
    Random random(seed);
    height_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(columns_));
    for (float& h : height_) h = static_cast<float>(random.uniform(-1.0, 1.0));
    for (int i = 0; i < spacing; ++i) {
      weights_.push_back(
          spline_weights((static_cast<float>(i) + 0.5F) / static_cast<float>(spacing)));
    }
  }

  void add_row(int iy, float scale, std::vector<float>& row) const {
    const std::array<float, 4>& wy = weights_[static_cast<std::size_t>(iy % spacing_)];
    std::vector<float> line(static_cast<std::size_t>(columns_), 0.0F);
    for (std::size_t j = 0; j < 4; ++j) {
      const float* heights = &height_[(static_cast<std::size_t>(iy / spacing_) + j) * line.size()];
      for (std::size_t k = 0; k < line.size(); ++k) line[k] += scale * wy[j] * heights[k];
    }
    for (std::size_t ix = 0; ix < row.size(); ++ix) {
      const std::array<float, 4>& wx = weights_[ix % static_cast<std::size_t>(spacing_)];
      const float* at = &line[ix / static_cast<std::size_t>(spacing_)];
      row[ix] += wx[0] * at[0] + wx[1] * at[1] + wx[2] * at[2] + wx[3] * at[3];
    }
  }

 private:
  int spacing_;
  int columns_;
  std::vector<float> height_;
  std::vector<std::array<float, 4>> weights_;
};

class Landscape {
 public:
  Landscape(int side, std::uint64_t seed)
      : side_(side), broad_(side, 40, 2 * seed), fine_(side, 13, 2 * seed + 1) {}

  std::vector<float> row(int iy) const {
    std::vector<float> heights(static_cast<std::size_t>(side_), 0.0F);
    broad_.add_row(iy, 1.0F, heights);
    fine_.add_row(iy, 0.3F, heights);
    return heights;
  }

  /// The height above which `share` of the cells lie, from a sample of rows and columns.
  float level(double share) const {
    std::vector<float> sample;
    const int step = std::max(1, side_ / 256);
    for (int iy = 0; iy < side_; iy += step) {
      const std::vector<float> heights = row(iy);
      for (std::size_t ix = 0; ix < heights.size(); ix += static_cast<std::size_t>(step)) {
        sample.push_back(heights[ix]);
      }
    }
    const auto at = sample.begin() +
                    static_cast<std::ptrdiff_t>((1.0 - share) * static_cast<double>(sample.size()));
    std::nth_element(sample.begin(), at, sample.end());
    return *at;
  }

 private:
  int side_;
  Hills broad_;
  Hills fine_;
};

// Property 3: where two obstacles touch only at a corner, the two cells between become obstacles.
void fill_corner_contacts(std::vector<std::uint8_t>& obstacle, std::size_t side) {
  for (bool changed = true; std::exchange(changed, false);) {
    for (std::size_t i = 0; i + side + 1 < obstacle.size(); ++i) {
      if (i % side == side - 1) continue;
      std::uint8_t& a = obstacle[i];
      std::uint8_t& b = obstacle[i + 1];
      std::uint8_t& c = obstacle[i + side];
      std::uint8_t& d = obstacle[i + side + 1];
      if (a == d && b == c && a != b) {
        a = b = c = d = 1;
        changed = true;
      }
    }
  }
}

bool is_clear(const ObstacleMap& map, Cell at, int clearance) {
  for (int dy = -clearance; dy <= clearance; ++dy) {
    for (int dx = -clearance; dx <= clearance; ++dx) {
      const Cell c{at.ix + dx, at.iy + dy};
      if (!map.grid.contains(c)) return false;
      if (dx * dx + dy * dy <= clearance * clearance && map.obstacle[map.grid.index(c)] != 0) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

ObstacleMap blob_map(int side, std::uint64_t seed) {
  ObstacleMap map;
  map.grid = {side, side, 0.0, 0.0, 2.0};
  map.obstacle.assign(map.grid.size(), 0);
  const Landscape landscape(side, seed);
  const float level = landscape.level(obstacle_share);
  const auto columns = static_cast<std::size_t>(side);
  for_rows(side, [&](int first, int last) {
    for (int iy = first; iy < last; ++iy) {
      const std::vector<float> heights = landscape.row(iy);
      std::uint8_t* row = &map.obstacle[static_cast<std::size_t>(iy) * columns];
      const bool rim = iy == 0 || iy == side - 1;
      for (std::size_t ix = 0; ix < columns; ++ix) row[ix] = rim || heights[ix] > level ? 1 : 0;
      row[0] = row[columns - 1] = 1;
    }
  });
  fill_corner_contacts(map.obstacle, columns);
  return map;
}

Cell open_place(const ObstacleMap& map, int clearance_cells) {
  const Cell middle{map.grid.nx / 2, map.grid.ny / 2};
  for (int ring = 0; ring < middle.ix; ++ring) {
    for (int dy = -ring; dy <= ring; ++dy) {
      const bool whole_row = dy == -ring || dy == ring;
      for (int dx = -ring; dx <= ring; dx += whole_row || ring == 0 ? 1 : 2 * ring) {
        const Cell c{middle.ix + dx, middle.iy + dy};
        if (is_clear(map, c, clearance_cells)) return c;
      }
    }
  }
  throw std::runtime_error("blob map: no open place of that size");
}

}  // namespace fairway::bench
