// Which cells a file names: areas, wholly inside; cells by number.
#include "fairway/map/read_region.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/map/cells_in_polygon.hpp"
#include "fairway/map/tangent_plane.hpp"
#include "fairway/map/testing/scratch_folder.hpp"

namespace fairway {
namespace {

constexpr Grid grid{9, 7, -10.0, 4.0, 2.0};

std::vector<std::uint8_t> read(const std::string& text, const Frame& frame = {}) {
  const ScratchFolder folder;
  return read_region(folder.write("region", text), grid, frame);
}

std::string refusal(const std::string& text) {
  try {
    (void)read(text);
    return "read";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string polygon(const std::string& rings) {
  return R"({"type":"Polygon","coordinates":[)" + rings + "]}";
}

int count(const std::vector<std::uint8_t>& cells) {
  return std::accumulate(cells.begin(), cells.end(), 0);
}

TEST(ReadRegion, TakesTheCellsWhollyInARectangleThatLiesOnTheGridsLines) {
  const auto cells = read(polygon("[[-8,6],[-2,6],[-2,12],[-8,12],[-8,6]]"));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell c = grid.cell_at(i);
    EXPECT_EQ(cells[i], c.ix >= 1 && c.ix < 4 && c.iy >= 1 && c.iy < 4 ? 1 : 0) << i;
  }
  EXPECT_EQ(count(read(polygon("[[-7.9,6],[-2,6],[-2,12],[-7.9,12],[-7.9,6]]"))), 6);
}

TEST(ReadRegion, LeavesOutHolesAndWhatTheyCut) {
  EXPECT_EQ(count(read(polygon("[[-10,4],[8,4],[8,18],[-10,18],[-10,4]],"
                               "[[-5,9],[-3,9],[-3,11],[-5,11],[-5,9]]"))),
            63 - 4);
}

TEST(ReadRegion, JoinsAreasOfFeaturesAndCollections) {
  const std::string low = "[[[-10,4],[-8,4],[-8,6],[-10,6],[-10,4]]]";
  const std::string high = "[[[6,16],[8,16],[8,18],[6,18],[6,16]]]";
  const auto cells = read(
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":)"
      R"({"type":"MultiPolygon","coordinates":[)" +
      low + "," + high + "]}}]}");
  EXPECT_EQ(count(cells), 2);
  EXPECT_EQ(cells.front() + cells.back(), 2);
}

TEST(ReadRegion, TakesCellsByNumber) {
  const auto cells = read("ix,iy\n0,0\n8,6\n0,0\n");
  EXPECT_EQ(count(cells), 2);
  EXPECT_EQ(cells.front() + cells.back(), 2);
}

TEST(ReadRegion, IsInDegreesWhereTheGridHasAPlaceOnEarth) {
  Frame frame;
  frame.geo = GeoReference{47.0, 8.0, 0.0};
  const TangentPlane plane({47.0, 8.0});
  std::string ring;
  for (const Vec2 p : {Vec2{-8.01, 5.99}, Vec2{-1.99, 5.99}, Vec2{-1.99, 12.01}, Vec2{-8.01, 12.01},
                       Vec2{-8.01, 5.99}}) {
    const GeodeticPoint at = plane.from_plane(p);
    ring += fmt::format("{}[{:.12f},{:.12f}]", ring.empty() ? "" : ",", at.longitude_deg,
                        at.latitude_deg);
  }
  EXPECT_EQ(read(polygon("[" + ring + "]"), frame),
            read(polygon("[[-8,6],[-2,6],[-2,12],[-8,12],[-8,6]]")));
}

TEST(ReadRegion, SaysWhereAFileIsWrong) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal("ix,iy\n0,0\n9,0\n"), HasSubstr(":3: is no cell"));
  EXPECT_THAT(refusal("ix,iy\n0.5,0\n"), HasSubstr(":2: is no cell"));
  EXPECT_THAT(refusal("x_m,y_m\n0,0\n"), HasSubstr("ix"));
  EXPECT_THAT(refusal(polygon("[[-9,5],[-8.5,5],[-8.5,5.5],[-9,5]]")), HasSubstr("no whole cell"));
  EXPECT_THAT(refusal(polygon("[[-8,6],[-2,12],[-2,6],[-8,12],[-8,6]]")), HasSubstr("crosses"));
  EXPECT_THAT(refusal(polygon("[[-8,6],[-2,6],[-2,12]]")), HasSubstr("closed ring"));
  EXPECT_THAT(refusal(polygon("[[-8,6],[-8,6],[-2,6],[-8,6]]")), HasSubstr("3 different"));
  EXPECT_THAT(refusal(polygon("")), HasSubstr("no ring"));
  EXPECT_THAT(refusal(R"({"type":"Point","coordinates":[0,5]})"), HasSubstr("expected areas"));
  EXPECT_THAT(refusal(R"({"type":"FeatureCollection","features":[]})"), HasSubstr("no whole cell"));
  EXPECT_THAT(refusal("{\n\"type\": }\n"), HasSubstr(":2: is not JSON"));
}

/// Whether a point lies in a ring, by its winding; for points away from the edges.
bool lies_in(const std::vector<Vec2>& ring, Vec2 p) {
  double angle = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - p;
    const Vec2 b = ring[(i + 1) % ring.size()] - p;
    angle += std::atan2(cross(a, b), dot(a, b));
  }
  return std::abs(angle) > 3.0;
}

TEST(MarkCellsIn, MarksACellWhenNoneOfItsPointsIsOutside) {
  Random random(12);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec2> ring;  // a star about the middle, some corners on the grid's lines
    const int corners = 3 + static_cast<int>(random.below(9));
    for (int k = 0; k < corners; ++k) {
      const double at = 6.2831853 * (k + 0.8 * random.unit()) / corners;
      const double reach_m = random.uniform(2.0, 12.0);
      Vec2 p{-1.0 + reach_m * std::cos(at), 11.0 + reach_m * std::sin(at)};
      if (random.below(3) == 0) p = {std::round(p.x / 2) * 2, std::round(p.y / 2) * 2};
      ring.push_back(p);
    }
    std::vector<std::uint8_t> cells(grid.size());
    mark_cells_in({{ring}}, grid, cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Vec2 corner = grid.corner(grid.cell_at(i));
      bool inside = true;
      for (int draw = 0; draw < 600; ++draw) {
        const Vec2 p = corner + 2.0 * Vec2{random.unit(), random.unit()};
        inside = inside && lies_in(ring, p);
      }
      if (cells[i] != 0) {
        EXPECT_TRUE(inside) << "trial " << trial << " cell " << i;
      } else if (inside) {  // then an edge cuts off a sliver: the corners moved in lie in
        const bool all = lies_in(ring, corner + Vec2{1e-4, 1e-4}) &&
                         lies_in(ring, corner + Vec2{2 - 1e-4, 1e-4}) &&
                         lies_in(ring, corner + Vec2{1e-4, 2 - 1e-4}) &&
                         lies_in(ring, corner + Vec2{2 - 1e-4, 2 - 1e-4});
        EXPECT_FALSE(all) << "trial " << trial << " cell " << i;
      }
    }
  }
}

}  // namespace
}  // namespace fairway
