#include "fairway/map/rasterise.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

using ::testing::HasSubstr;

SourceRaster random_raster(Random& random, int width, int height, double density) {
  SourceRaster raster;
  raster.width = width;
  raster.height = height;
  raster.pixel_width_m = random.uniform(0.2, 3.0);
  raster.pixel_height_m = random.below(2) == 0 ? raster.pixel_width_m : random.uniform(0.2, 3.0);
  raster.lower_left_m = {random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0)};
  for (int i = 0; i < width * height; ++i)
    raster.pixels.push_back(random.unit() >= density ? Pixel::free
                            : random.below(3) == 0   ? Pixel::unknown
                                                     : Pixel::obstacle);
  return raster;
}

double gap(double a_low, double a_high, double b_low, double b_high) {
  return std::max({0.0, a_low - b_high, b_low - a_high});
}

// The definition, pixel by pixel and cell by cell; nothing when rounding could decide.
std::optional<bool> blocked_by_definition(const SourceRaster& raster, const Grid& grid, Cell cell,
                                          const RasteriseOptions& options) {
  const Vec2 low = grid.corner(cell) - raster.lower_left_m;
  const Vec2 high = low + Vec2{grid.cell_m, grid.cell_m};
  const double doubt = 1e-7;
  bool doubtful = false;
  bool blocked = false;
  const auto judge = [&](double dx, double dy, double overlap_x, double overlap_y) {
    const double distance = std::hypot(dx, dy);
    if (options.growth_m > 0.0) {
      if (std::abs(distance - options.growth_m) < doubt) doubtful = true;
      blocked |= distance < options.growth_m;
    } else {
      if (std::min(std::abs(overlap_x), std::abs(overlap_y)) < doubt) doubtful = true;
      blocked |= overlap_x > 0.0 && overlap_y > 0.0;
    }
  };
  for (int r = 0; r < raster.height; ++r) {
    for (int c = 0; c < raster.width; ++c) {
      const Pixel pixel = raster.row(r)[c];
      if (pixel == Pixel::free || (pixel == Pixel::unknown && !options.unknown_is_obstacle))
        continue;
      const double px = c * raster.pixel_width_m;
      const double py = (raster.height - 1 - r) * raster.pixel_height_m;
      const double px2 = px + raster.pixel_width_m;
      const double py2 = py + raster.pixel_height_m;
      judge(gap(low.x, high.x, px, px2), gap(low.y, high.y, py, py2),
            std::min(high.x, px2) - std::max(low.x, px),
            std::min(high.y, py2) - std::max(low.y, py));
    }
  }
  if (options.outside_is_obstacle) {
    const double width = raster.width * raster.pixel_width_m;
    const double height = raster.height * raster.pixel_height_m;
    const double inside = std::min({low.x, low.y, width - high.x, height - high.y});
    if (std::abs(inside - options.growth_m) < doubt) doubtful = true;
    blocked |= inside < options.growth_m;
  }
  if (doubtful) return std::nullopt;
  return blocked;
}

TEST(RasterisePixels, AgreesWithTheDefinitionOnRandomRasters) {
  std::size_t decided = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random = Random::stream(41, seed);
    const SourceRaster raster =
        random_raster(random, 1 + static_cast<int>(random.below(24)),
                      1 + static_cast<int>(random.below(24)), random.uniform(0.0, 0.2));
    RasteriseOptions options;
    options.cell_m = random.uniform(0.15, 6.0);
    options.growth_m = random.below(3) == 0 ? 0.0 : random.uniform(0.0, 8.0);
    options.unknown_is_obstacle = random.below(2) == 0;
    options.outside_is_obstacle = random.below(2) == 0;
    const ObstacleMap map = rasterise(raster, options);
    ASSERT_EQ(map.obstacle.size(), map.grid.size());
    for (std::size_t i = 0; i < map.grid.size(); ++i) {
      const auto expected = blocked_by_definition(raster, map.grid, map.grid.cell_at(i), options);
      if (!expected) continue;
      ++decided;
      ASSERT_EQ(map.obstacle[i] != 0, *expected)
          << "seed " << seed << " cell " << map.grid.cell_at(i).ix << "," << map.grid.cell_at(i).iy
          << " cell_m " << options.cell_m << " growth " << options.growth_m;
    }
  }
  EXPECT_GT(decided, 10000U);
}

TEST(RasterisePixels, CellsAsLargeAsPixelsReproduceTheImage) {
  // Sides without an exact binary form, and grids long enough to accumulate rounding.
  for (const double pixel_m : {0.05, 0.1, 1.0 / 3.0, 0.0504, 2.0}) {
    Random random(7);
    SourceRaster raster = random_raster(random, 997, 3, 0.3);
    raster.pixel_width_m = raster.pixel_height_m = pixel_m;
    for (const int times : {1, 2, 7}) {
      RasteriseOptions options;
      options.cell_m = times * pixel_m;
      options.outside_is_obstacle = false;
      const ObstacleMap map = rasterise(raster, options);
      ASSERT_EQ(map.grid.nx, (997 + times - 1) / times);
      for (int iy = 0; iy < map.grid.ny; ++iy)
        for (int ix = 0; ix < map.grid.nx; ++ix) {
          bool any = false;
          for (int y = iy * times; y < std::min(3, (iy + 1) * times); ++y)
            for (int x = ix * times; x < std::min(997, (ix + 1) * times); ++x)
              any |= raster.row(2 - y)[x] != Pixel::free;
          ASSERT_EQ(map.obstacle[map.grid.index({ix, iy})] != 0, any) << pixel_m << " x" << times;
        }
    }
  }
}

TEST(RasterisePixels, RasteringItsOwnOutputAgainChangesNothing) {
  Random random(11);
  const SourceRaster raster = random_raster(random, 40, 30, 0.1);
  RasteriseOptions options;
  options.cell_m = 1.7;
  options.outside_is_obstacle = false;
  const ObstacleMap once = rasterise(raster, options);
  SourceRaster again;
  again.width = once.grid.nx;
  again.height = once.grid.ny;
  again.pixel_width_m = again.pixel_height_m = options.cell_m;
  again.lower_left_m = {once.grid.x0_m, once.grid.y0_m};
  for (int iy = once.grid.ny - 1; iy >= 0; --iy)
    for (int ix = 0; ix < once.grid.nx; ++ix)
      again.pixels.push_back(static_cast<Pixel>(once.obstacle[once.grid.index({ix, iy})]));
  const ObstacleMap twice = rasterise(again, options);
  EXPECT_EQ(twice.grid, once.grid);
  EXPECT_EQ(twice.obstacle, once.obstacle);
}

TEST(RasterisePixels, TheOutsideIsARingOfObstaclesOrNothing) {
  SourceRaster raster;
  raster.width = 4;
  raster.height = 3;
  raster.lower_left_m = {10.0, 20.0};
  raster.pixels.assign(12, Pixel::free);
  RasteriseOptions options;
  options.cell_m = 2.0;
  const ObstacleMap closed = rasterise(raster, options);
  EXPECT_EQ(closed.grid, (Grid{4, 4, 8.0, 18.0, 2.0}));
  // The upper row of cells extends beyond the 3 m high map.
  const std::vector<std::uint8_t> expected = {1, 1, 1, 1,  //
                                              1, 0, 0, 1,  //
                                              1, 1, 1, 1,  //
                                              1, 1, 1, 1};
  EXPECT_EQ(closed.obstacle, expected);
  options.outside_is_obstacle = false;
  const ObstacleMap open = rasterise(raster, options);
  EXPECT_EQ(open.grid, (Grid{2, 2, 10.0, 20.0, 2.0}));
  EXPECT_EQ(open.obstacle, std::vector<std::uint8_t>(4, 0));
}

TEST(RasterisePixels, TooManyCellsAreRefusedBeforeTheyAreMade) {
  SourceRaster raster;
  raster.width = raster.height = 1;
  raster.pixels.assign(1, Pixel::free);
  RasteriseOptions options;
  for (const double cell_m : {1e-9, 1e-300}) {
    options.cell_m = cell_m;
    try {
      (void)rasterise(raster, options);
      FAIL() << "no error";
    } catch (const InputError& error) {
      EXPECT_EQ(error.where(), "map.cell_m");
      EXPECT_THAT(error.what(), HasSubstr("use larger cells"));
    }
  }
}

// ---- fences ----

double distance_m(Vec2 p, Vec2 a, Vec2 b) {
  const double t = std::clamp(dot(p - a, b - a) / std::max(norm2(b - a), 1e-300), 0.0, 1.0);
  return norm(p - (a + t * (b - a)));
}

bool inside(const FencePolygon& polygon, Vec2 p) {
  bool odd = false;
  for (const auto& ring : polygon.rings_m)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i];
      const Vec2 b = ring[(i + 1) % ring.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
        odd = !odd;
    }
  return odd;
}

double distance_to_edges_m(const FencePolygon& polygon, Vec2 p) {
  double nearest = 1e300;
  for (const auto& ring : polygon.rings_m)
    for (std::size_t i = 0; i < ring.size(); ++i)
      nearest = std::min(nearest, distance_m(p, ring[i], ring[(i + 1) % ring.size()]));
  return nearest;
}

// How far a point is from what must not be touched; 0 inside it.
double clearance_m(const FenceSet& fences, Inclusion inclusion, Vec2 p) {
  double clearance = 1e300;
  for (const auto& polygon : fences.keep_out)
    clearance = std::min(clearance, inside(polygon, p) ? 0.0 : distance_to_edges_m(polygon, p));
  for (const auto& circle : fences.keep_out_circles)
    clearance = std::min(clearance, std::max(0.0, norm(p - circle.center_m) - circle.radius_m));
  double in_all = 1e300;
  double in_any = -1.0;
  for (const auto& polygon : fences.keep_in) {
    const double room = inside(polygon, p) ? distance_to_edges_m(polygon, p) : 0.0;
    in_all = std::min(in_all, room);
    in_any = std::max(in_any, room);
  }
  for (const auto& circle : fences.keep_in_circles) {
    const double room = std::max(0.0, circle.radius_m - norm(p - circle.center_m));
    in_all = std::min(in_all, room);
    in_any = std::max(in_any, room);
  }
  // For a union, the largest clearance is only a lower bound; enough where one fence decides.
  return std::min(clearance, in_any < 0.0 ? 1e300 : inclusion == Inclusion::all ? in_all : in_any);
}

// Simple by construction: corners at increasing angles about a centre.
std::vector<Vec2> random_star(Random& random, Vec2 center, double size_m) {
  const int corners = 3 + static_cast<int>(random.below(7));
  std::vector<Vec2> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = two_pi * (i + random.uniform(0.0, 0.7)) / corners;
    const double radius = size_m * random.uniform(0.3, 1.0);
    ring.push_back(center + Vec2{radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

FenceSet random_fences(Random& random, bool several_keep_in) {
  const auto place = [&] { return Vec2{random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0)}; };
  FenceSet fences;
  for (std::uint64_t i = random.below(3); i > 0; --i) {
    FencePolygon polygon;
    const Vec2 center = place();
    polygon.rings_m.push_back(random_star(random, center, random.uniform(1.0, 12.0)));
    if (random.below(2) == 0) {  // a hole inside, a scaled copy
      auto hole = polygon.rings_m.front();
      for (Vec2& p : hole) p = center + 0.5 * (p - center);
      polygon.rings_m.push_back(hole);
    }
    fences.keep_out.push_back(polygon);
  }
  for (std::uint64_t i = random.below(3); i > 0; --i)
    fences.keep_out_circles.push_back({place(), random.uniform(0.1, 6.0)});
  const std::uint64_t polygons = several_keep_in ? 2 : random.below(2);
  for (std::uint64_t i = 0; i < polygons; ++i)
    fences.keep_in.push_back({{random_star(random, 0.3 * place(), 25.0)}});
  if (several_keep_in || random.below(3) == 0)
    fences.keep_in_circles.push_back({0.3 * place(), random.uniform(12.0, 25.0)});
  fences.places_m.push_back(place());
  return fences;
}

// Points of a cell, including its corners; the nearest sample is at most `step` from any point.
template <typename Visit>
void for_samples(const Grid& grid, Cell cell, int per_side, const Visit& visit) {
  for (int i = 0; i <= per_side; ++i)
    for (int j = 0; j <= per_side; ++j)
      visit(grid.corner(cell) + Vec2{grid.cell_m * i / per_side, grid.cell_m * j / per_side});
}

void expect_conservative_and_tight(const FenceSet& fences, const RasteriseOptions& options,
                                   Inclusion inclusion, std::uint64_t seed) {
  ObstacleMap map;
  try {
    map = rasterise(fences, options, inclusion, 2.0);
  } catch (const InputError&) {
    return;  // keep-in fences that do not meet
  }
  constexpr int per_side = 12;
  const double step_m = options.cell_m / per_side;
  const bool has_keep_in = !fences.keep_in.empty() || !fences.keep_in_circles.empty();
  for (int iy = 0; iy < map.grid.ny; ++iy) {
    for (int ix = 0; ix < map.grid.nx; ++ix) {
      double least = 1e300;
      for_samples(map.grid, {ix, iy}, per_side,
                  [&](Vec2 p) { least = std::min(least, clearance_m(fences, inclusion, p)); });
      const bool blocked = map.obstacle[map.grid.index({ix, iy})] != 0;
      if (!blocked) {  // no point of a free cell may be within the growth
        ASSERT_GT(least, options.growth_m - 1e-6) << "seed " << seed << " " << ix << "," << iy;
      } else if (has_keep_in || !options.outside_is_obstacle) {
        // A blocked cell has a point about that close; samples miss it by at most 0.71 steps.
        ASSERT_LE(least, options.growth_m + 0.75 * step_m + 2e-3 * options.cell_m)
            << "seed " << seed << " " << ix << "," << iy;
      }
    }
  }
}

TEST(RasteriseFences, NoFreeCellIsTouchedAndNoBlockedCellIsFarOnRandomFences) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    Random random = Random::stream(42, seed);
    const FenceSet fences = random_fences(random, false);
    RasteriseOptions options;
    options.cell_m = random.uniform(0.7, 4.0);
    options.growth_m = random.below(3) == 0 ? 0.0 : random.uniform(0.0, 5.0);
    options.outside_is_obstacle = false;
    expect_conservative_and_tight(fences, options, Inclusion::all, seed);
    if (HasFatalFailure()) return;
  }
}

TEST(RasteriseFences, SeveralKeepInFencesMeanTheirIntersectionWithAll) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random = Random::stream(43, seed);
    const FenceSet fences = random_fences(random, true);
    RasteriseOptions options;
    options.cell_m = random.uniform(0.7, 4.0);
    options.growth_m = random.below(2) == 0 ? 0.0 : random.uniform(0.0, 3.0);
    expect_conservative_and_tight(fences, options, Inclusion::all, seed);
    if (HasFatalFailure()) return;
  }
}

TEST(RasteriseFences, SeveralKeepInFencesMeanTheirUnionWithAny) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random = Random::stream(44, seed);
    FenceSet fences = random_fences(random, true);
    fences.keep_out.clear();
    fences.keep_out_circles.clear();
    RasteriseOptions options;
    options.cell_m = random.uniform(0.7, 4.0);
    options.outside_is_obstacle = false;
    const ObstacleMap map = rasterise(fences, options, Inclusion::any, std::nullopt);
    for (std::size_t i = 0; i < map.grid.size(); ++i) {
      const Cell cell = map.grid.cell_at(i);
      bool sampled_outside = false;
      for_samples(map.grid, cell, 12, [&](Vec2 p) {
        bool in_any = false;
        for (const auto& polygon : fences.keep_in) in_any |= inside(polygon, p);
        for (const auto& circle : fences.keep_in_circles)
          in_any |= norm(p - circle.center_m) < circle.radius_m;
        sampled_outside |= !in_any;
      });
      if (map.obstacle[i] == 0) {
        ASSERT_FALSE(sampled_outside) << seed;
      } else {
        // Blocked cells have a point near the outside: no fence contains the cell with clearance.
        const double room = clearance_m(fences, Inclusion::any, map.grid.center(cell));
        ASSERT_LE(room, 0.7072 * options.cell_m * 1.01) << seed;
      }
    }
  }
}

TEST(RasteriseFences, TheUnionOfTwoFencesWithACommonEdgeHasNoWallBetween) {
  FenceSet fences;
  fences.keep_in.push_back({{{{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}}}});
  fences.keep_in.push_back({{{{4.0, 0.0}, {8.0, 0.0}, {8.0, 4.0}, {4.0, 4.0}}}});
  RasteriseOptions options;
  options.cell_m = 0.5;
  options.outside_is_obstacle = false;
  const ObstacleMap any = rasterise(fences, options, Inclusion::any, std::nullopt);
  for (int ix = 1; ix < 15; ++ix) EXPECT_EQ(any.obstacle[any.grid.index({ix, 4})], 0) << ix;
  EXPECT_EQ(any.obstacle[any.grid.index({0, 4})], 1) << "touches the fence";
  const ObstacleMap all = rasterise(fences, options, Inclusion::all, std::nullopt);
  EXPECT_EQ(std::count(all.obstacle.begin(), all.obstacle.end(), 0), 0);
}

TEST(RasteriseFences, ClosedSetsThatOnlyTouchACellBlockIt) {
  FenceSet fences;
  fences.keep_out.push_back({{{{2.0, 2.0}, {3.0, 2.0}, {3.0, 3.0}, {2.0, 3.0}}}});
  fences.places_m = {{0.0, 0.0}, {5.0, 5.0}};
  RasteriseOptions options;
  options.outside_is_obstacle = false;
  const ObstacleMap map = rasterise(fences, options, Inclusion::all, 0.0);
  ASSERT_EQ(map.grid, (Grid{5, 5, 0.0, 0.0, 1.0}));
  for (int iy = 0; iy < 5; ++iy)
    for (int ix = 0; ix < 5; ++ix)
      EXPECT_EQ(map.obstacle[map.grid.index({ix, iy})] != 0,
                ix >= 1 && ix <= 3 && iy >= 1 && iy <= 3);
}

TEST(RasteriseFences, WithoutAKeepInFenceTheWorldHasRoomAroundWhatIsNamed) {
  FenceSet fences;
  fences.places_m = {{0.0, 0.0}, {100.0, 20.0}};
  RasteriseOptions options;
  options.outside_is_obstacle = false;
  const ObstacleMap map = rasterise(fences, options, Inclusion::all, std::nullopt);
  EXPECT_EQ(map.grid, (Grid{120, 40, -10.0, -10.0, 1.0}));
  const ObstacleMap wide = rasterise(fences, options, Inclusion::all, 50.0);
  EXPECT_EQ(wide.grid, (Grid{200, 120, -50.0, -50.0, 1.0}));
  EXPECT_THROW((void)rasterise(FenceSet{}, options, Inclusion::all, std::nullopt), InputError);
}

}  // namespace
}  // namespace fairway
