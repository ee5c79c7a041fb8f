#include "fairway/vehicle/path_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fairway/base/random.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway {
namespace {

PathMission random_path(Random& random, std::size_t least_vertices = 2) {
  PathMission path;
  path.closed = random.below(2) == 0;
  const auto vertices = least_vertices + random.below(10);
  for (std::size_t k = 0; k < vertices; ++k) {
    const bool again = k > least_vertices && random.below(8) == 0;
    path.vertices_m.push_back(again ? path.vertices_m.back()
                                    : Vec2{random.uniform(0.0, 40.0), random.uniform(0.0, 40.0)});
  }
  return path;
}

Vec2 random_place(Random& random) {
  return {random.uniform(-10.0, 50.0), random.uniform(-10.0, 50.0)};
}

Vec2 place_at(const PathMission& path, double station_m) {
  Vec2 at = path.vertices_m.front();
  for_pieces(path, [&](const PathPiece& piece) {
    if (station_m >= 0.0) at = piece.at(std::min(station_m, piece.length_m));
    station_m -= piece.length_m;
  });
  return at;
}

const PathMission corner{{{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}}, false};

TEST(PathFrame, IsTheNearestPointOfPieceByPieceWithASide) {
  Random random(81);
  for (int i = 0; i < 300; ++i) {
    const PathMission path = random_path(random);
    const PathLocator locator(path);
    for (int k = 0; k < 50; ++k) {
      const Vec2 p = random_place(random);
      const PathFrame frame = locator.frame(p);
      const PathPoint nearest = nearest_on_path(p, path);
      ASSERT_EQ(frame.station_m, nearest.along_m);
      ASSERT_EQ(std::abs(frame.offset_m), nearest.distance_m);
      ASSERT_NEAR(norm(frame.tangent), 1.0, 1e-12);
      // From the nearest point, back to the place: along the normal, and beyond an end.
      if (frame.beyond_m == 0.0) {
        const Vec2 back = place_at(path, frame.station_m) + frame.offset_m * left_of(frame.tangent);
        ASSERT_NEAR(norm(back - p), 0.0, 1e-9);
      } else {
        ASSERT_FALSE(path.closed);
        ASSERT_LE(frame.beyond_m, nearest.distance_m + 1e-12);
      }
    }
  }
}

TEST(PathFrame, IsTheSameMirroredWithTheOtherSide) {
  Random random(82);
  for (int i = 0; i < 100; ++i) {
    const PathMission path = random_path(random, 3);  // of two the turn back has a side of its own
    PathMission mirrored = path;
    for (Vec2& v : mirrored.vertices_m) v.y = -v.y;
    const PathLocator here(path);
    const PathLocator there(mirrored);
    const Vec2 p = random_place(random);
    const PathFrame a = here.frame(p);
    const PathFrame b = there.frame({p.x, -p.y});
    EXPECT_EQ(a.station_m, b.station_m);
    EXPECT_EQ(a.offset_m, -b.offset_m);
    EXPECT_EQ(a.tangent.x, b.tangent.x);
    EXPECT_EQ(a.tangent.y, -b.tangent.y);
    EXPECT_EQ(a.beyond_m, b.beyond_m);
  }
}

TEST(PathFrame, OfThePlaceAtAStationHasThatStation) {
  Random random(83);
  for (int i = 0; i < 100; ++i) {
    const PathMission path = random_path(random, 3);
    const PathLocator locator(path);
    const double station_m = random.uniform(0.0, locator.length_m());
    EXPECT_NEAR(norm(locator.place(station_m) - place_at(path, station_m)), 0.0, 1e-9);
    if (path.closed) {
      const Vec2 again = locator.place(station_m - 2.0 * locator.length_m());
      EXPECT_NEAR(norm(again - locator.place(station_m)), 0.0, 1e-9);
    } else {
      const PathFrame beyond = locator.frame(locator.place(locator.length_m() + 1e-3));
      EXPECT_NEAR(beyond.beyond_m, 1e-3, 1e-9);
      EXPECT_NEAR(locator.frame(locator.place(-1e-3)).beyond_m, 1e-3, 1e-9);
    }
  }
}

TEST(PathFrame, HasTheLeftOfTheDirectionPositive) {
  const PathLocator locator(corner);
  EXPECT_EQ(locator.frame({5.0, 2.0}).offset_m, 2.0);
  EXPECT_EQ(locator.frame({5.0, -2.0}).offset_m, -2.0);
  EXPECT_EQ(locator.frame({8.5, 6.0}).offset_m, 1.5);
  EXPECT_EQ(locator.frame({8.5, 6.0}).station_m, 16.0);
}

TEST(PathFrame, TurnsWithThePlaceOutsideAVertex) {
  const PathLocator locator(corner);
  Heading last = Heading::from_rad(0.0);
  for (double angle = -1.57; angle < 0.0; angle += 0.05) {
    const PathFrame frame = locator.frame(Vec2{10.0, 0.0} + 3.0 * Heading::from_rad(angle).unit());
    EXPECT_EQ(frame.station_m, 10.0);
    EXPECT_NEAR(frame.offset_m, -3.0, 1e-12);
    EXPECT_NEAR(last.turn_to(Heading::of(frame.tangent)), 0.0, 0.0501);
    last = Heading::of(frame.tangent);
  }
  EXPECT_NEAR(last.rad(), pi / 2, 0.06);
}

TEST(PathFrame, SaysHowFarBeyondAnEndOfAnOpenPathAPlaceLies) {
  const PathLocator locator(corner);
  const PathFrame after = locator.frame({12.0, 13.0});
  EXPECT_EQ(after.beyond_m, 3.0);
  EXPECT_EQ(after.station_m, 20.0);
  EXPECT_LT(after.offset_m, 0.0);
  EXPECT_EQ(after.tangent, (Vec2{0.0, 1.0}));
  const PathFrame before = locator.frame({-4.0, 1.0});
  EXPECT_EQ(before.beyond_m, 4.0);
  EXPECT_EQ(before.station_m, 0.0);
  EXPECT_GT(before.offset_m, 0.0);
  EXPECT_EQ(before.tangent, (Vec2{1.0, 0.0}));
  PathMission loop = corner;
  loop.closed = true;
  EXPECT_EQ(PathLocator(loop).frame({-4.0, 1.0}).beyond_m, 0.0);
}

TEST(PathFrame, OfThereAndBackHasThePlaceBeyondTheTurnOnTheRight) {
  const PathLocator locator(PathMission{{{0.0, 0.0}, {10.0, 0.0}}, true});
  const PathFrame frame = locator.frame({12.0, 0.0});
  EXPECT_EQ(frame.offset_m, -2.0);
  EXPECT_EQ(frame.tangent, (Vec2{0.0, 1.0}));
}

TEST(PathFrame, HasBothSidesBesideAVertexOnAStraightLine) {
  const PathLocator locator(PathMission{{{0.0, 0.0}, {5.0, 0.0}, {10.0, 0.0}}, false});
  for (const double side : {-2.0, 2.0}) {
    const PathFrame frame = locator.frame({5.0, side});
    EXPECT_EQ(frame.offset_m, side);
    EXPECT_EQ(frame.tangent, (Vec2{1.0, 0.0}));
  }
}

TEST(PathFrame, OnAVertexItselfIsThePieceBeforeIt) {
  const PathFrame frame = PathLocator(corner).frame({10.0, 0.0});
  EXPECT_EQ(frame.offset_m, 0.0);
  EXPECT_EQ(frame.tangent, (Vec2{1.0, 0.0}));
}

TEST(PathFrame, OfAPathWithoutLengthIsInfinitelyFar) {
  const PathMission point{{{1.0, 1.0}, {1.0, 1.0}}, false};
  EXPECT_FALSE(std::isfinite(PathLocator(point).frame({0.0, 0.0}).offset_m));
}

}  // namespace
}  // namespace fairway
