#include "fairway/field/gaussian_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <tuple>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/field/gaussian_band.hpp"
#include "fairway/field/testing/sample_maps.hpp"

namespace fairway {
namespace {

using samples::Mask;

VectorField random_field(Random& random, std::size_t cells, double empty) {
  VectorField out(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const double angle = random.uniform(-3.2, 3.2);
    if (random.unit() < empty) continue;
    out.x[i] = static_cast<float>(std::cos(angle));
    out.y[i] = static_cast<float>(std::sin(angle));
  }
  return out;
}

double weight(int k, double sigma) { return std::exp(-k * k / (2.0 * sigma * sigma)); }

struct Plane {
  std::vector<double> x;
  std::vector<double> y;
};

// Eqs. 19 to 21 in double, term by term, over the cells that exist; without the constant factor.
Plane convolved(const VectorField& f, int nx, int ny, double sigma) {
  const int r = static_cast<int>(std::ceil(2.0 * sigma));  // Eq. 20: n = 2 r + 1
  Plane out{std::vector<double>(f.x.size()), std::vector<double>(f.x.size())};
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      double x = 0.0;
      double y = 0.0;
      for (int v = std::max(0, iy - r); v <= std::min(ny - 1, iy + r); ++v) {
        for (int u = std::max(0, ix - r); u <= std::min(nx - 1, ix + r); ++u) {
          const double w =
              std::exp(-((u - ix) * (u - ix) + (v - iy) * (v - iy)) / (2.0 * sigma * sigma));
          const std::size_t i = static_cast<std::size_t>(v * nx + u);
          x += w * static_cast<double>(f.x[i]);
          y += w * static_cast<double>(f.y[i]);
        }
      }
      out.x[static_cast<std::size_t>(iy * nx + ix)] = x;
      out.y[static_cast<std::size_t>(iy * nx + ix)] = y;
    }
  }
  return out;
}

// What a cell sees, in double: along its row, then along its column, up to the first wall.
Plane convolved_between_walls(const VectorField& f, const Mask& wall, double sigma) {
  const int r = static_cast<int>(std::ceil(2.0 * sigma));
  Plane in{{f.x.begin(), f.x.end()}, {f.y.begin(), f.y.end()}};
  for (const bool along_x : {true, false}) {
    Plane out{std::vector<double>(f.x.size()), std::vector<double>(f.x.size())};
    for (int iy = 0; iy < wall.ny; ++iy) {
      for (int ix = 0; ix < wall.nx; ++ix) {
        const std::size_t here = wall.index(ix, iy);
        for (const int way : {0, -1, 1}) {
          for (int k = way == 0 ? 0 : 1; k <= (way == 0 ? 0 : r); ++k) {
            const int u = along_x ? ix + way * k : ix;
            const int v = along_x ? iy : iy + way * k;
            if (u < 0 || v < 0 || u >= wall.nx || v >= wall.ny || wall.at(u, v) != 0) break;
            if (wall.at(ix, iy) != 0) break;
            out.x[here] += weight(k, sigma) * in.x[wall.index(u, v)];
            out.y[here] += weight(k, sigma) * in.y[wall.index(u, v)];
          }
        }
      }
    }
    in = out;
  }
  return in;
}

// Equal up to one positive factor, the same for all cells: a constant does not turn a vector.
void expect_proportional(const VectorField& found, const Plane& exact, double sigma) {
  double scale = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < exact.x.size(); ++i) {
    if (std::fabs(exact.x[i]) > largest) {
      largest = std::fabs(exact.x[i]);
      scale = static_cast<double>(found.x[i]) / exact.x[i];
    }
  }
  if (largest == 0.0) scale = 1.0;
  ASSERT_GT(scale, 0.0);
  double total = 0.0;  // the sum of all weights: what rounding is measured against
  const int r = static_cast<int>(std::ceil(2.0 * sigma));
  for (int k = -r; k <= r; ++k) total += weight(k, sigma);
  const double tolerance = 2e-6 * total * total;
  for (std::size_t i = 0; i < exact.x.size(); ++i) {
    ASSERT_NEAR(static_cast<double>(found.x[i]) / scale, exact.x[i], tolerance) << "cell " << i;
    ASSERT_NEAR(static_cast<double>(found.y[i]) / scale, exact.y[i], tolerance) << "cell " << i;
  }
}

const std::vector<std::array<int, 2>> shapes{{1, 1},  {1, 37},  {37, 1}, {2, 2},   {5, 64},
                                             {64, 5}, {33, 29}, {70, 3}, {300, 9}, {9, 300}};
const std::vector<double> sigmas{0.1, 0.5, 0.51, 1.0, 2.3, 4.0, 9.7, 16.0, 40.0};

TEST(GaussianFilter, HasTheKernelOfEquation20) {
  for (const auto& [sigma, half] : std::vector<std::pair<double, int>>{
           {0.1, 1}, {0.5, 1}, {0.51, 2}, {1.0, 2}, {2.0, 4}, {4.0, 8}, {6.0, 12}, {2.25, 5}}) {
    EXPECT_EQ(gaussian_half_width(sigma), half) << "sigma " << sigma;
  }
  for (const double bad : {0.0, -1.0, std::nan(""), 1e300}) {
    EXPECT_THROW((void)gaussian_half_width(bad), PreconditionViolation);
  }
}

TEST(GaussianFilter, OneVectorBecomesTheKernelAndNothingElse) {
  for (const double sigma : {0.7, 2.0, 4.0}) {
    const int half = gaussian_half_width(sigma);
    VectorField f(61 * 61);
    f.x[30 * 61 + 30] = 1.0F;
    gaussian_filter(f, 61, 61, sigma);
    const double middle = f.x[30 * 61 + 30];
    ASSERT_GT(middle, 0.0);
    for (int iy = 0; iy < 61; ++iy) {
      for (int ix = 0; ix < 61; ++ix) {
        const std::size_t i = static_cast<std::size_t>(iy * 61 + ix);
        const bool inside = std::abs(ix - 30) <= half && std::abs(iy - 30) <= half;
        const double expected = inside ? weight(ix - 30, sigma) * weight(iy - 30, sigma) : 0.0;
        ASSERT_NEAR(f.x[i] / middle, expected, 1e-6) << ix << ", " << iy << ", sigma " << sigma;
        ASSERT_EQ(f.y[i], 0.0F);
      }
    }
  }
}

TEST(GaussianFilter, IsTheConvolutionOfEquation21OnEveryShape) {
  Random random(121);
  for (const auto& [nx, ny] : shapes) {
    for (const double sigma : sigmas) {
      VectorField f = random_field(random, static_cast<std::size_t>(nx * ny), 0.2);
      const Plane exact = convolved(f, nx, ny, sigma);
      gaussian_filter(f, nx, ny, sigma);
      SCOPED_TRACE(testing::Message() << nx << " x " << ny << ", sigma " << sigma);
      expect_proportional(f, exact, sigma);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(GaussianFilter, LeavesAUniformFieldsDirectionAloneUpToTheMapsEdge) {
  VectorField f(40 * 30);
  std::fill(f.x.begin(), f.x.end(), 0.6F);
  std::fill(f.y.begin(), f.y.end(), -0.8F);
  gaussian_filter(f, 40, 30, 5.0);
  for (std::size_t i = 0; i < f.x.size(); ++i) {
    EXPECT_NEAR(std::atan2(f.y[i], f.x[i]), std::atan2(-0.8, 0.6), 1e-6);
  }
}

TEST(GaussianFilterBetweenWalls, IsTheSumOfWhatACellSees) {
  Random random(122);
  for (const auto& [nx, ny] : shapes) {
    for (const double sigma : {0.1, 1.0, 4.0, 16.0}) {
      for (const double density : {0.0, 0.02, 0.3, 1.0}) {
        const Mask wall = samples::speckled(random, nx, ny, density);
        VectorField f = random_field(random, wall.cells.size(), 0.2);
        const Plane exact = convolved_between_walls(f, wall, sigma);
        gaussian_filter_between_walls(f, wall.cells, nx, ny, sigma);
        SCOPED_TRACE(testing::Message()
                     << nx << " x " << ny << ", sigma " << sigma << ", walls " << density);
        expect_proportional(f, exact, sigma);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(GaussianFilterBetweenWalls, WithoutWallsIsThePlainFilter) {
  Random random(123);
  const Mask wall(130, 70);
  for (const double sigma : {0.6, 3.0, 12.0}) {
    VectorField f = random_field(random, wall.cells.size(), 0.1);
    VectorField plain = f;
    gaussian_filter_between_walls(f, wall.cells, wall.nx, wall.ny, sigma);
    gaussian_filter(plain, wall.nx, wall.ny, sigma);
    for (std::size_t i = 0; i < f.x.size(); ++i) {
      ASSERT_NEAR(f.x[i], plain.x[i], 1e-4);
      ASSERT_NEAR(f.y[i], plain.y[i], 1e-4);
    }
  }
}

bool same_bits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(GaussianFilterBetweenWalls, NotABitLeaksThroughAWallOneCellThick) {
  Random random(124);
  constexpr int n = 90;
  // Straight, slanted with touching corners, and closed: `left` says which side a cell is on.
  const auto straight = [](int ix, int) { return ix - 45; };
  const auto slanted = [](int ix, int iy) { return ix - iy; };
  const auto yard = [](int ix, int iy) {
    return std::max(std::abs(ix - 40), std::abs(iy - 50)) - 20;
  };
  for (int shape = 0; shape < 3; ++shape) {
    Mask wall(n, n);
    std::vector<int> side(wall.cells.size());
    for (int iy = 0; iy < n; ++iy) {
      for (int ix = 0; ix < n; ++ix) {
        const int s = shape == 0 ? straight(ix, iy) : shape == 1 ? slanted(ix, iy) : yard(ix, iy);
        side[wall.index(ix, iy)] = s;
        wall.at(ix, iy) = s == 0 ? 1 : 0;
      }
    }
    for (const double sigma : {1.0, 4.0, 16.0}) {
      const VectorField f = random_field(random, wall.cells.size(), 0.1);
      VectorField other = f;
      for (std::size_t i = 0; i < side.size(); ++i) {
        if (side[i] > 0) std::tie(other.x[i], other.y[i]) = std::pair{-f.y[i], 7.0F * f.x[i]};
        if (side[i] == 0) other.x[i] = 100.0F;  // walls do not contribute
      }
      VectorField a = f;
      VectorField b = other;
      gaussian_filter_between_walls(a, wall.cells, n, n, sigma);
      gaussian_filter_between_walls(b, wall.cells, n, n, sigma);
      std::size_t changed = 0;
      for (std::size_t i = 0; i < side.size(); ++i) {
        if (side[i] < 0) {
          ASSERT_TRUE(same_bits(a.x[i], b.x[i]) && same_bits(a.y[i], b.y[i]))
              << "cell " << i << ", shape " << shape << ", sigma " << sigma;
        }
        changed += side[i] > 0 && a.x[i] != b.x[i] ? 1 : 0;
      }
      EXPECT_GT(changed, 1000U);
    }
  }
}

TEST(GaussianFilterBetweenWalls, AMapOfWallsAloneGivesNothing) {
  Random random(125);
  const Mask wall(30, 20, 1);
  VectorField f = random_field(random, wall.cells.size(), 0.0);
  gaussian_filter_between_walls(f, wall.cells, 30, 20, 4.0);
  EXPECT_TRUE(std::all_of(f.x.begin(), f.x.end(), [](float v) { return v == 0.0F; }));
  EXPECT_TRUE(std::all_of(f.y.begin(), f.y.end(), [](float v) { return v == 0.0F; }));
}

TEST(GaussianFilterBetweenWalls, RefusesWallsOfAnotherSize) {
  VectorField f(12);
  const Mask wall(3, 3);
  EXPECT_THROW(gaussian_filter_between_walls(f, wall.cells, 4, 3, 1.0), PreconditionViolation);
}

// A plane in bands of `height` rows, one after another.
std::vector<float> filtered_in_bands(BandFilter filter, std::vector<float> plane, const Mask& wall,
                                     bool walls, std::span<const float> weight,
                                     std::size_t height) {
  const std::vector<float> before = plane;
  const auto columns = static_cast<std::size_t>(wall.nx);
  const auto rows = static_cast<std::size_t>(wall.ny);
  const std::size_t reach = weight.size() - 1;
  for (std::size_t first = 0; first < rows; first += height) {
    const std::size_t last = std::min(first + height, rows);
    filter({.plane = plane.data(),
            .below = first < reach ? nullptr : before.data() + (first - reach) * columns,
            .above = before.data() + last * columns,
            .wall = walls ? wall.cells.data() : nullptr,
            .columns = columns,
            .rows = rows,
            .first_row = first,
            .last_row = last,
            .weight = weight.data(),
            .reach = reach});
  }
  return plane;
}

TEST(GaussianBand, GivesTheSameBitsOnEveryWidthAndInBandsOfAnyHeight) {
  Random random(127);
  for (const auto& [nx, ny] : std::vector<std::array<int, 2>>{{1, 1}, {17, 90}, {300, 121}}) {
    const Mask wall = samples::speckled(random, nx, ny, 0.03);
    const VectorField f = random_field(random, wall.cells.size(), 0.1);
    for (const std::size_t reach : {1, 8, 33}) {
      std::vector<float> weights;
      for (std::size_t k = 0; k <= reach; ++k) {
        weights.push_back(
            static_cast<float>(weight(static_cast<int>(k), 0.5 * static_cast<double>(reach))));
      }
      for (const bool walls : {false, true}) {
        const std::vector<float> expected =
            filtered_in_bands(band_filters().front(), f.x, wall, walls, weights, wall.cells.size());
        for (const BandFilter filter : band_filters()) {
          for (const std::size_t height : {reach, std::size_t{48}, std::size_t{1000}}) {
            const std::vector<float> found =
                filtered_in_bands(filter, f.x, wall, walls, weights, std::max(height, reach));
            ASSERT_EQ(std::memcmp(found.data(), expected.data(), sizeof(float) * found.size()), 0)
                << nx << " x " << ny << ", reach " << reach << ", walls " << walls << ", bands of "
                << height;
          }
        }
      }
    }
  }
}

TEST(GaussianFilterOnThreads, GivesTheSameBitsOnAnyNumber) {
  Random random(126);
  const Mask wall = samples::blobs(random, 700, 260, 60, 6.0);
  const VectorField f = random_field(random, wall.cells.size(), 0.05);
  for (const double sigma : {1.0, 4.0, 16.0}) {
    for (const bool walls : {false, true}) {
      const auto filtered = [&] {
        VectorField out = f;
        if (walls) {
          gaussian_filter_between_walls(out, wall.cells, wall.nx, wall.ny, sigma);
        } else {
          gaussian_filter(out, wall.nx, wall.ny, sigma);
        }
        return out;
      };
      const VectorField one = samples::on_threads(1, filtered);
      for (const int threads : {2, 5}) {
        const VectorField many = samples::on_threads(threads, filtered);
        EXPECT_EQ(one.x, many.x) << threads << " threads, sigma " << sigma;
        EXPECT_EQ(one.y, many.y) << threads << " threads, sigma " << sigma;
      }
    }
  }
}

}  // namespace
}  // namespace fairway
