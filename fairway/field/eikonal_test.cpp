#include "fairway/field/eikonal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/field/octile.hpp"
#include "fairway/field/testing/sample_maps.hpp"

namespace fairway {
namespace {

using samples::Mask;
using Sources = std::vector<EikonalSource>;

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::vector<float> solved(const Mask& inside, const Sources& sources) {
  return eikonal_distance(inside.cells, inside.nx, inside.ny, sources);
}

double between(const Mask& m, std::size_t a, std::size_t b) {
  const auto n = static_cast<std::size_t>(m.nx);
  return std::hypot(static_cast<double>(a % n) - static_cast<double>(b % n),
                    static_cast<double>(a / n) - static_cast<double>(b / n));
}

// The least of the eight triangles about a cell, in double; +inf beyond the map.
double least_of_triangles(const Mask& m, const std::vector<double>& u, int ix, int iy) {
  const auto value = [&](int x, int y) {
    return x < 0 || y < 0 || x >= m.nx || y >= m.ny ? std::numeric_limits<double>::infinity()
                                                    : u[m.index(x, y)];
  };
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [ax, ay] :
       std::array<std::array<int, 2>, 4>{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}}) {
    for (const int turn : {-1, 1}) {
      const double a = value(ix + ax, iy + ay);
      const double b = value(ix + ax - turn * ay, iy + ay + turn * ax);
      best = std::min({best, a + 1.0, b + std::numbers::sqrt2});
      const double drop = a - b;
      if (drop > 0.0 && drop < std::numbers::sqrt2 / 2.0) {
        best = std::min(best, a + std::sqrt(1.0 - drop * drop));
      }
    }
  }
  return best;
}

// The same equations, solved differently: Gauss-Seidel sweeps in double until nothing changes.
std::vector<double> by_sweeping(const Mask& inside, const Sources& sources) {
  std::vector<double> u(inside.cells.size(), std::numeric_limits<double>::infinity());
  for (const EikonalSource& s : sources) {
    if (inside.cells[s.index] != 0) {
      u[s.index] = std::min(u[s.index], static_cast<double>(s.distance_cells));
    }
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const bool down : {false, true}) {
      for (std::size_t k = 0; k < u.size(); ++k) {
        const std::size_t i = down ? u.size() - 1 - k : k;
        if (inside.cells[i] == 0) continue;
        const double value = least_of_triangles(inside, u, static_cast<int>(i) % inside.nx,
                                                static_cast<int>(i) / inside.nx);
        if (value < u[i] - 1e-12) {
          u[i] = value;
          changed = true;
        }
      }
    }
  }
  return u;
}

void expect_solution(const Mask& inside, const Sources& sources) {
  const std::vector<float> found = solved(inside, sources);
  const std::vector<double> exact = by_sweeping(inside, sources);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (std::isinf(exact[i])) {
      ASSERT_EQ(found[i], inf) << "cell " << i << " of " << inside.nx << " x " << inside.ny;
    } else {
      ASSERT_NEAR(found[i], exact[i], 2e-6 * (1.0 + exact[i]))
          << "cell " << i << " of " << inside.nx << " x " << inside.ny;
    }
  }
}

Sources some_sources(Random& random, const Mask& m, int count, double largest) {
  Sources out;
  for (int k = 0; k < count; ++k) {
    out.push_back({static_cast<std::uint32_t>(random.below(m.cells.size())),
                   static_cast<float>(random.uniform(0.0, largest))});
  }
  return out;
}

TEST(Eikonal, SolvesItsEquationsLikeSweepsInDouble) {
  Random random(51);
  for (const auto& [nx, ny] : std::vector<std::array<int, 2>>{
           {1, 1}, {1, 25}, {25, 1}, {2, 2}, {3, 40}, {40, 3}, {45, 35}}) {
    for (const double open : {0.0, 0.55, 0.7, 0.9, 0.99, 1.0}) {
      const Mask inside = samples::speckled(random, nx, ny, open);
      for (const int count : {0, 1, 5, 40}) {
        for (const double largest : {0.0, 0.6, 30.0}) {
          expect_solution(inside, some_sources(random, inside, count, largest));
        }
      }
    }
  }
}

RC_GTEST_PROP(EikonalProperty, SolvesItsEquationsOnDrawnMaps, ()) {
  Mask inside(*rc::gen::inRange(1, 20), *rc::gen::inRange(1, 20));
  inside.cells = *rc::gen::container<std::vector<std::uint8_t>>(
      inside.cells.size(), rc::gen::weightedElement<std::uint8_t>({{1, 0}, {4, 1}}));
  const auto index =
      rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(inside.cells.size()));
  const auto starts = *rc::gen::container<std::vector<std::pair<std::uint32_t, int>>>(
      rc::gen::pair(index, rc::gen::inRange(0, 200)));
  Sources sources;
  for (const auto& [i, tenths] : starts) {
    sources.push_back({i, static_cast<float>(tenths) / 10.0F});
  }
  expect_solution(inside, sources);
}

TEST(Eikonal, BlobsOfObstaclesAreWalkedAround) {
  Random random(52);
  for (int map = 0; map < 4; ++map) {
    const Mask inside = samples::blobs(random, 90, 70, 25, 9.0).inverted();
    expect_solution(inside, some_sources(random, inside, 6, 2.0));
  }
}

// An open square of 100 m, for any cell size, with exact distances in a disc about its centre (a
// single cell if the disc has no radius). Errors are positive where the result is too large.
struct OpenError {
  double worst_relative = 0.0;
  double worst_m = 0.0;
  double least_relative = 0.0;
};
OpenError open_error(int cells_per_side, double disc_m) {
  const Mask inside(cells_per_side, cells_per_side, 1);
  const double cell_m = 100.0 / cells_per_side;
  const std::size_t middle = inside.index(cells_per_side / 2, cells_per_side / 2);
  Sources sources;
  for (std::uint32_t i = 0; i < inside.cells.size(); ++i) {
    const double d = between(inside, i, middle);
    if (d * cell_m <= disc_m) sources.push_back({i, static_cast<float>(d)});
  }
  const std::vector<float> found = solved(inside, sources);
  OpenError out;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double d = between(inside, i, middle);
    const double error = found[i] - d;
    out.worst_m = std::max(out.worst_m, error * cell_m);
    if (d == 0.0) continue;
    out.worst_relative = std::max(out.worst_relative, error / d);
    out.least_relative = std::min(out.least_relative, error / d);
  }
  return out;
}

TEST(Eikonal, FromADiscTheErrorHalvesWithTheCell) {
  // Measured: 0.78 %, 0.37 %, 0.18 %, 0.09 % of the distance with 5, 10, 20, 40 cells in the
  // disc's radius, and 0.32 m, 0.16 m, 0.081 m, 0.041 m at the corners of the square.
  double coarser_m = 0.0;
  for (const auto& [cells, worst_relative] :
       std::vector<std::pair<int, double>>{{51, 0.008}, {101, 0.004}, {201, 0.002}, {401, 0.001}}) {
    const OpenError e = open_error(cells, 10.0);
    EXPECT_LT(e.worst_relative, worst_relative) << cells << " cells a side";
    EXPECT_GT(e.least_relative, -4e-6) << "float rounding apart it never comes out too short";
    if (coarser_m > 0.0) {
      EXPECT_GT(coarser_m / e.worst_m, 1.9) << cells << " cells a side";
      EXPECT_LT(coarser_m / e.worst_m, 2.1) << cells << " cells a side";
    }
    coarser_m = e.worst_m;
  }
}

TEST(Eikonal, FromASingleCellTheErrorIsAFewPartsInAHundredNearItAndGrowsByALogarithm) {
  // Measured: 3.95 % a knight's move from the source; 0.27, 0.33, 0.39, 0.45 cells at the corners
  // of squares of 51, 101, 201, 401 cells: first order except for the logarithm of a point source.
  double before_cells = 0.0;
  for (const int cells : {51, 101, 201, 401}) {
    const OpenError e = open_error(cells, 0.0);
    EXPECT_LT(e.worst_relative, 0.0396);
    EXPECT_GT(e.least_relative, -4e-6);
    const double error_cells = e.worst_m * cells / 100.0;
    if (before_cells > 0.0) {
      EXPECT_NEAR(error_cells - before_cells, 0.062, 0.004) << cells << " cells a side";
    }
    before_cells = error_cells;
  }
  EXPECT_LT(before_cells, 0.46);
}

TEST(Eikonal, AroundACornerItNearsTheWayByTheCornerFromAbove) {
  // A wall from the south up to half the height; the way behind it bends at the free cell above
  // the wall.
  double before_cells = 0.0;
  for (const int n : {41, 81, 161, 321}) {
    Mask inside(n, n, 1);
    const int half = n / 2;
    for (int iy = 0; iy < half; ++iy) inside.at(half, iy) = 0;
    const int away = n / 4;
    const std::uint32_t source = inside.index(half - away, half - away);
    const std::uint32_t top = inside.index(half, half);
    const std::vector<float> found = solved(inside, {{source, 0.0F}});
    double worst_cells = 0.0;
    for (int iy = 0; iy < n; ++iy) {
      for (int ix = 0; ix < n; ++ix) {
        const std::uint32_t i = inside.index(ix, iy);
        if (inside.cells[i] == 0) continue;
        const bool seen = ix <= half || iy - half >= ix - half;  // line past the corner: 45 deg
        const double exact = seen ? between(inside, i, source)
                                  : between(inside, source, top) + between(inside, top, i);
        ASSERT_GE(found[i], exact * (1.0 - 4e-6)) << "cell " << ix << ", " << iy << " of " << n;
        worst_cells = std::max(worst_cells, found[i] - exact);
      }
    }
    // Measured: 0.40, 0.45, 0.51, 0.57 cells, two logarithms (source and corner) included.
    if (before_cells > 0.0) {
      EXPECT_NEAR(worst_cells - before_cells, 0.056, 0.006) << n << " cells a side";
    }
    before_cells = worst_cells;
  }
  EXPECT_LT(before_cells, 0.58);
}

TEST(Eikonal, FromOneSourceItNeverComesOutBelowTheStraightDistance) {
  Random random(53);
  for (int map = 0; map < 60; ++map) {
    const Mask inside = samples::speckled(random, 60, 50, random.uniform(0.6, 1.0));
    const Sources source = some_sources(random, inside, 1, 5.0);
    if (inside.cells[source[0].index] == 0) continue;
    const std::vector<float> found = solved(inside, source);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double straight = source[0].distance_cells + between(inside, i, source[0].index);
      ASSERT_GE(found[i], straight * (1.0 - 2e-6)) << "map " << map << ", cell " << i;
    }
  }
}

TEST(Eikonal, CellsOutsideTheRegionAndWalledOffPocketsStayInfinite) {
  const Mask inside = samples::drawn({"........",  //
                                      ".#####..",  //
                                      ".#...#..",  //
                                      ".#...#..",  //
                                      ".#####..",  //
                                      "........"})
                          .inverted();
  const std::vector<float> found = solved(inside, {{0, 0.0F}});
  for (int iy = 0; iy < inside.ny; ++iy) {
    for (int ix = 0; ix < inside.nx; ++ix) {
      const bool pocket = ix >= 2 && ix <= 4 && iy >= 2 && iy <= 3;
      const std::size_t i = inside.index(ix, iy);
      EXPECT_EQ(std::isfinite(found[i]), inside.cells[i] != 0 && !pocket) << ix << ", " << iy;
    }
  }
}

TEST(Eikonal, WithoutSourcesOrWithSourcesOutsideTheRegionNothingIsReached) {
  Mask inside(5, 4, 1);
  inside.at(2, 2) = 0;
  const std::vector<float> nothing(inside.cells.size(), inf);
  EXPECT_EQ(solved(inside, {}), nothing);
  EXPECT_EQ(solved(inside, {{inside.index(2, 2), 0.0F}}), nothing);
  EXPECT_TRUE(eikonal_distance({}, 0, 0, {}).empty());
}

TEST(Eikonal, OfSeveralSourcesInACellTheNearestCounts) {
  const Mask inside(30, 20, 1);
  const std::uint32_t i = inside.index(7, 9);
  const std::vector<float> once = solved(inside, {{i, 1.25F}});
  EXPECT_EQ(solved(inside, {{i, 1.25F}, {i, 1.25F}}), once);
  EXPECT_EQ(solved(inside, {{i, 9.0F}, {i, 1.25F}, {i, 3.0F}}), once);
  EXPECT_EQ(once[i], 1.25F);
}

TEST(Eikonal, ASourceThatAnotherReachesSoonerIsLowered) {
  const Mask inside(10, 1, 1);
  const std::vector<float> found = solved(inside, {{0, 0.0F}, {5, 100.0F}, {9, 7.5F}});
  for (int ix = 0; ix < 9; ++ix) EXPECT_FLOAT_EQ(found[ix], static_cast<float>(std::min(ix, 99)));
  EXPECT_FLOAT_EQ(found[9], 7.5F);
}

TEST(Eikonal, FarFromTheSourcesAFloatStillSteps) {
  const Mask inside(60, 3, 1);
  const std::vector<float> found = solved(inside, {{0, 999'000.0F}});
  for (int ix = 0; ix < 60; ++ix) {
    EXPECT_NEAR(found[inside.index(ix, 0)], 999'000.0 + ix, 0.125 * (1 + ix)) << ix;
  }
}

TEST(Eikonal, InCorridorsOneCellWideTheWayIsAsLongAsTheEightConnectedPath) {
  Mask inside(151, 151);
  for (int iy = 0; iy < inside.ny; ++iy) {
    for (int ix = 0; ix < inside.nx; ++ix) {
      const bool gap = iy % 4 == 1 ? ix == inside.nx - 1 : ix == 0;
      inside.at(ix, iy) = iy % 2 == 0 || gap ? 1 : 0;
    }
  }
  const std::vector<float> found = solved(inside, {{0, 0.0F}});
  const std::vector<float> path =
      octile_distance(inside.cells, inside.nx, inside.ny, std::vector<std::uint32_t>{0});
  double longest = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (inside.cells[i] == 0) continue;
    ASSERT_NEAR(found[i], path[i], 2e-5 * (1.0 + path[i])) << "cell " << i;
    longest = std::max<double>(longest, path[i]);
  }
  EXPECT_GT(longest, 11'000.0);
}

TEST(Eikonal, ASpiralIsFollowedToItsEnd) {
  // A wall of one cell winds inwards; the corridor between its turns is three cells wide.
  constexpr int n = 83;
  Mask inside(n, n, 1);
  int x = 3, y = 3, dx = 1, dy = 0;
  int steps = n - 7;
  for (int arm = 0; steps > 4; ++arm) {
    for (int k = 0; k < steps; ++k, x += dx, y += dy) inside.at(x, y) = 0;
    if (arm % 2 == 1 || arm == 0) steps -= arm == 0 ? 0 : 4;
    std::tie(dx, dy) = std::pair{-dy, dx};
  }
  inside.at(x, y) = 0;
  const Sources sources{{inside.index(0, 0), 0.0F}};
  expect_solution(inside, sources);
  const std::vector<float> found = solved(inside, sources);
  const float longest = *std::max_element(found.begin(), found.end(), [](float a, float b) {
    return (std::isinf(a) ? 0.0F : a) < (std::isinf(b) ? 0.0F : b);
  });
  EXPECT_GT(longest, 8.0F * n) << "the spiral is not a spiral";
}

TEST(Eikonal, ASymmetricMapGetsASymmetricAnswerToTheBit) {
  Random random(54);
  Mask inside = samples::blobs(random, 61, 61, 14, 5.0).inverted();
  for (int turn = 0; turn < 3; ++turn) {
    const std::vector<std::uint8_t> turned = samples::quarter_turned(inside.cells, 61, 61);
    for (std::size_t i = 0; i < turned.size(); ++i) inside.cells[i] &= turned[i];
  }
  inside.at(30, 30) = 1;
  inside.at(29, 30) = inside.at(31, 30) = inside.at(30, 29) = inside.at(30, 31) = 1;
  const std::vector<float> found = solved(inside, {{inside.index(30, 30), 0.0F}});
  EXPECT_EQ(found, samples::quarter_turned(found, 61, 61));
  const std::vector<std::uint8_t> mirror = samples::mirrored(inside.cells, 61, 61);
  Mask image(61, 61);
  image.cells = mirror;
  EXPECT_EQ(solved(image, {{inside.index(30, 30), 0.0F}}), samples::mirrored(found, 61, 61));
}

TEST(Eikonal, TheSameBitsOnAnyNumberOfThreadsOnAGridLargeEnoughToShare) {
  Random random(55);
  const Mask inside = samples::blobs(random, 720, 700, 240, 18.0).inverted();
  ASSERT_GT(inside.cells.size(), 500'000U);
  Sources sources = some_sources(random, inside, 300, 40.0);
  const auto solve = [&] { return solved(inside, sources); };
  const std::vector<float> one = samples::on_threads(1, solve);
  for (const int threads : {2, 3}) {
    EXPECT_EQ(samples::on_threads(threads, solve), one) << threads << " threads";
  }
  const auto reached = std::count_if(one.begin(), one.end(), [](float v) { return v < inf; });
  EXPECT_GT(reached, 250'000);
}

TEST(Eikonal, RefusesSourcesOffTheGridOrWithoutADistance) {
  const Mask inside(4, 3, 1);
  for (const EikonalSource bad :
       {EikonalSource{12, 0.0F}, EikonalSource{0, -1.0F}, EikonalSource{0, nan},
        EikonalSource{0, inf}, EikonalSource{0, 1.0e6F}}) {
    EXPECT_THROW((void)solved(inside, {bad}), PreconditionViolation) << bad.distance_cells;
  }
  EXPECT_THROW((void)eikonal_distance(inside.cells, 4, 4, {}), PreconditionViolation);
  EXPECT_THROW((void)eikonal_distance(inside.cells, -4, -3, {}), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
