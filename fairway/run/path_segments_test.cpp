#include "fairway/run/path_segments.hpp"

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

State random_pose(Random& random, double far_m) {
  return {{random.uniform(-far_m, far_m), random.uniform(-far_m, far_m)},
          Heading::from_rad(random.uniform(-pi, pi))};
}

double curvature_at(const DubinsPath& path, double driven_m) {
  for (const DubinsPart& part : parts_of(path)) {
    if (driven_m < part.length_m) return part.curvature_per_m;
    driven_m -= part.length_m;
  }
  return 0.0;
}

TEST(PathSegments, AreThePathFromItsStartToItsEnd) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const double r = random.uniform(0.5, 5.0);
    const State goal = random_pose(random, 20.0);
    const DubinsPath path = shortest_path(random_pose(random, 20.0), goal, r);
    double driven_m = 0.0;
    for (const FlightSegment& piece : segments_of(path)) {
      EXPECT_GT(piece.length_m, 0.0);
      const State begin = pose_at(path, driven_m);
      EXPECT_LE(norm(piece.start.position_m - begin.position_m), 1e-9);
      EXPECT_EQ(piece.curvature_per_m, curvature_at(path, driven_m + piece.length_m / 2));
      driven_m += piece.length_m;
      const State end = state_at(piece, piece.length_m);
      EXPECT_LE(norm(end.position_m - pose_at(path, driven_m).position_m), 1e-9);
    }
    EXPECT_NEAR(driven_m, path.length_m(), 1e-12 * (1.0 + driven_m));
  }
}

TEST(PathSegments, OfAPathToItsOwnStartAreNone) {
  const State pose{{3.0, 4.0}, Heading::from_rad(1.0)};
  EXPECT_TRUE(segments_of(shortest_path(pose, pose, 2.0)).empty());
}

}  // namespace
}  // namespace fairway
