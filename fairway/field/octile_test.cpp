#include "fairway/field/octile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/field/testing/sample_maps.hpp"

namespace fairway {
namespace {

using samples::Mask;

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr std::array<std::array<int, 2>, 4> axial_steps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
constexpr std::array<std::array<int, 2>, 4> diagonal_steps{{{1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};

bool on(const Mask& m, int ix, int iy) { return ix >= 0 && iy >= 0 && ix < m.nx && iy < m.ny; }

// Dijkstra's algorithm with a heap, in double.
std::vector<double> by_dijkstra(const Mask& inside, const std::vector<std::uint32_t>& sources) {
  std::vector<double> cost(inside.cells.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const std::uint32_t s : sources) {
    if (inside.cells[s] == 0) continue;
    cost[s] = 0.0;
    open.push({0.0, s});
  }
  while (!open.empty()) {
    const auto [here, i] = open.top();
    open.pop();
    if (here > cost[i]) continue;
    const int ix = static_cast<int>(i) % inside.nx;
    const int iy = static_cast<int>(i) / inside.nx;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if ((dx == 0 && dy == 0) || !on(inside, ix + dx, iy + dy)) continue;
        const std::uint32_t n = inside.index(ix + dx, iy + dy);
        const double there = here + (dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0);
        if (inside.cells[n] == 0 || there >= cost[n]) continue;
        cost[n] = there;
        open.push({there, n});
      }
    }
  }
  return cost;
}

void expect_dijkstra(const Mask& inside, const std::vector<std::uint32_t>& sources) {
  SCOPED_TRACE(testing::Message() << inside.nx << " x " << inside.ny << " cells");
  const std::vector<float> found = octile_distance(inside.cells, inside.nx, inside.ny, sources);
  const std::vector<double> exact = by_dijkstra(inside, sources);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (std::isinf(exact[i])) {
      ASSERT_EQ(found[i], inf) << "cell " << i;
    } else {
      ASSERT_NEAR(found[i], exact[i], 1e-7 * exact[i]) << "cell " << i;  // one float rounding
    }
  }
}

std::vector<std::uint32_t> some_cells(Random& random, const Mask& m, int count) {
  std::vector<std::uint32_t> out;
  for (int k = 0; k < count; ++k) {
    out.push_back(static_cast<std::uint32_t>(random.below(m.cells.size())));
  }
  return out;
}

TEST(OctileDistance, AgreesWithDijkstra) {
  Random random(41);
  for (const auto& [nx, ny] : std::vector<std::array<int, 2>>{
           {1, 1}, {1, 30}, {30, 1}, {2, 2}, {7, 50}, {50, 7}, {64, 48}}) {
    for (const double open : {0.0, 0.5, 0.65, 0.8, 0.97, 1.0}) {
      const Mask inside = samples::speckled(random, nx, ny, open);
      for (const int sources : {0, 1, 2, 9}) {
        expect_dijkstra(inside, some_cells(random, inside, sources));
      }
    }
  }
}

TEST(OctileDistance, LongWaysThroughAMazeAreExact) {
  Mask inside(201, 201);
  for (int iy = 0; iy < inside.ny; ++iy) {
    for (int ix = 0; ix < inside.nx; ++ix) {
      const bool gap = iy % 4 == 1 ? ix == inside.nx - 1 : ix == 0;
      inside.at(ix, iy) = iy % 2 == 0 || gap ? 1 : 0;
    }
  }
  expect_dijkstra(inside, {0});
}

TEST(OctileDistance, DiagonalStepsPassBetweenTwoBlockedCells) {
  const Mask inside = samples::drawn({".#", "#."});
  const std::vector<float> found =
      octile_distance(inside.cells, 2, 2, std::vector<std::uint32_t>{0});
  EXPECT_FLOAT_EQ(found[3], std::numbers::sqrt2_v<float>);
  EXPECT_EQ(found[1], inf);
}

TEST(OctileDistance, RefusesSourcesOffTheGridAndWrongSizes) {
  const Mask inside(3, 2, 1);
  const std::vector<std::uint32_t> off{6};
  EXPECT_THROW((void)octile_distance(inside.cells, 3, 2, off), PreconditionViolation);
  EXPECT_THROW((void)octile_distance(inside.cells, 3, 3, {}), PreconditionViolation);
  EXPECT_THROW((void)paper_wavefront(inside.cells, 3, 2, off, 1.0F, 0), PreconditionViolation);
  EXPECT_THROW((void)paper_wavefront(inside.cells, 3, 3, {}, 1.0F, 0), PreconditionViolation);
}

// Lines 3 to 13 of Algorithm 2, and 4 to 15 of Algorithm 1: a new map from the old one, sweep by
// sweep over the whole map. 0 is a cell to be filled, -1 one that is left out.
std::vector<float> by_whole_sweeps(const Mask& inside, const std::vector<std::uint32_t>& sources,
                                   float first, int sweeps) {
  std::vector<float> m(inside.cells.size());
  for (std::size_t i = 0; i < m.size(); ++i) m[i] = inside.cells[i] != 0 ? 0.0F : -1.0F;
  for (const std::uint32_t s : sources) m[s] = first;
  const auto least = [&](int ix, int iy, const auto& steps) {
    float out = inf;
    for (const auto& [dx, dy] : steps) {
      if (!on(inside, ix + dx, iy + dy)) continue;
      const float n = m[inside.index(ix + dx, iy + dy)];
      if (n >= first) out = std::min(out, n);
    }
    return out;
  };
  bool changed = true;
  for (int sweep = 0; changed && (sweeps == 0 || sweep < sweeps); ++sweep) {
    changed = false;
    std::vector<float> next = m;
    for (int iy = 0; iy < inside.ny; ++iy) {
      for (int ix = 0; ix < inside.nx; ++ix) {
        if (m[inside.index(ix, iy)] != 0.0F) continue;
        float value = least(ix, iy, axial_steps) + 1.0F;
        if (value == inf) value = least(ix, iy, diagonal_steps) + 1.41F;
        if (value == inf) continue;
        next[inside.index(ix, iy)] = value;
        changed = true;
      }
    }
    m = next;
  }
  for (float& value : m) {
    if (value <= 0.0F) value = inf;
  }
  return m;
}

TEST(PaperWavefront, IsThePrintedAlgorithmWithWholeSweeps) {
  Random random(42);
  for (const auto& [nx, ny] : std::vector<std::array<int, 2>>{
           {1, 1}, {1, 20}, {20, 1}, {2, 2}, {5, 33}, {33, 5}, {40, 30}}) {
    for (const double open : {0.0, 0.5, 0.7, 0.95, 1.0}) {
      const Mask inside = samples::speckled(random, nx, ny, open);
      for (const int count : {0, 1, 4}) {
        const std::vector<std::uint32_t> sources = some_cells(random, inside, count);
        for (const int sweeps : {0, 1, 2, 7}) {
          for (const float first : {1.0F, 2.0F}) {
            ASSERT_EQ(paper_wavefront(inside.cells, nx, ny, sources, first, sweeps),
                      by_whole_sweeps(inside, sources, first, sweeps))
                << nx << " x " << ny << ", " << open << " open, " << count << " sources, " << sweeps
                << " sweeps";
          }
        }
      }
    }
  }
}

TEST(PaperWavefront, AxialNeighboursGoFirstEvenWhereADiagonalOneIsCheaper) {
  // The middle cell of the second row is reached in the third sweep: from its axial neighbour at
  // two diagonal steps, though its diagonal neighbour is at two axial ones.
  const Mask inside = samples::drawn({"...####",  //
                                      "###..##",  //
                                      "#####.#",  //
                                      "######."})
                          .inverted();
  const std::vector<std::uint32_t> sources{inside.index(0, 3), inside.index(6, 0)};
  const std::size_t middle = inside.index(3, 2);
  EXPECT_FLOAT_EQ(paper_wavefront(inside.cells, 7, 4, sources, 2.0F, 0)[middle],
                  2.0F + 2 * 1.41F + 1.0F);
  EXPECT_FLOAT_EQ(octile_distance(inside.cells, 7, 4, sources)[middle],
                  2.0F + std::numbers::sqrt2_v<float>);
}

TEST(PaperWavefront, SweepsReachASquare) {
  const Mask inside(21, 21, 1);
  const std::vector<float> found = paper_wavefront(
      inside.cells, 21, 21, std::vector<std::uint32_t>{inside.index(10, 10)}, 1.0F, 4);
  for (int iy = 0; iy < 21; ++iy) {
    for (int ix = 0; ix < 21; ++ix) {
      const int chebyshev = std::max(std::abs(ix - 10), std::abs(iy - 10));
      EXPECT_EQ(std::isfinite(found[inside.index(ix, iy)]), chebyshev <= 4);
    }
  }
}

}  // namespace
}  // namespace fairway
