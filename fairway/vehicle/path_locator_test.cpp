#include "fairway/vehicle/path_locator.hpp"

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

/// With repeated vertices, and pieces that lie on each other.
PathMission random_path(Random& random, std::size_t vertices) {
  PathMission path;
  path.closed = random.below(2) == 0;
  path.delta_position_m = random.uniform(0.5, 6.0);
  path.delta_heading_rad = random.uniform(0.2, 3.0);
  for (std::size_t k = 0; k < vertices; ++k) {
    const bool again = k > 1 && random.below(8) == 0;
    path.vertices_m.push_back(again ? path.vertices_m[random.below(k)]
                                    : Vec2{random.uniform(0.0, 40.0), random.uniform(0.0, 40.0)});
  }
  path.vertices_m.push_back({50.0, 50.0});
  return path;
}

TEST(PathLocator, AnswersAsPieceByPiece) {
  Random random(71);
  for (int i = 0; i < 300; ++i) {
    const PathMission path = random_path(random, 1 + random.below(i % 10 == 0 ? 300 : 12));
    const PathLocator locator(path);
    std::size_t guess = random.below(locator.size());  // of the point before
    for (int k = 0; k < 60; ++k) {
      State s{{random.uniform(-10.0, 60.0), random.uniform(-10.0, 60.0)},
              Heading::from_rad(random.uniform(-pi, pi))};
      if (k % 7 == 0) s.position_m = path.vertices_m[random.below(path.vertices_m.size())];
      const PathPoint expected = nearest_on_path(s.position_m, path);
      const PathPoint found = locator.nearest(s.position_m);
      ASSERT_EQ(found.distance_m, expected.distance_m);
      ASSERT_EQ(found.along_m, expected.along_m);
      ASSERT_EQ(found.tangent.rad(), expected.tangent.rad());
      ASSERT_EQ(locator.on_path(s), on_path(s, path));
      ASSERT_EQ(locator.on_path(s, guess), on_path(s, path));
      const PathPoint guessed = locator.nearest(s.position_m, guess);
      ASSERT_LT(guess, locator.size());
      ASSERT_EQ(guessed.along_m, expected.along_m);
      ASSERT_EQ(guessed.tangent.rad(), expected.tangent.rad());
      const double limit_m = expected.distance_m + random.uniform(-1.0, 1.0);
      const auto within = locator.nearest_within(s.position_m, limit_m);
      ASSERT_EQ(within.has_value(), expected.distance_m <= limit_m);
      if (within.has_value()) {
        ASSERT_EQ(within->along_m, expected.along_m);
      }
    }
    double length_m = 0.0;
    for_pieces(path, [&](const PathPiece& piece) { length_m += piece.length_m; });
    EXPECT_EQ(locator.length_m(), length_m);
  }
}

TEST(PathLocator, RefusesAPathOfOneVertex) {
  EXPECT_THROW(PathLocator(PathMission{{{1.0, 2.0}}, false}), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
