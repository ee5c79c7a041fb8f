#include "fairway/cellular/compute_cell_sets.hpp"

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/cellular/border_forward_set.hpp"
#include "fairway/cellular/border_frame.hpp"

namespace fairway {
namespace {

/// A heading that enters by a side, away from running along it.
double entering(Side entry, Random& random) {
  return (static_cast<int>(entry) + 1) * (pi / 2) + random.uniform(0.01, pi - 0.01);
}

TEST(CellSets, MatchWhereAndWithWhichHeadingExactMotionLeaves) {
  Random random(4);
  const CellShape shape{8.0, 20.0};
  for (int trial = 0; trial < 400; ++trial) {
    const Direction command = trial % 40 == 0
                                  ? Direction::none()
                                  : Direction::of(Heading::from_rad(random.uniform(-pi, pi)));
    const CellSets sets = compute_cell_sets(command, shape, 5);
    ASSERT_EQ(sets.along_m.size(), 5U);
    for (const Side entry : all_sides) {
      for (std::size_t i = 0; i < 5; ++i) {
        const Heading heading = Heading::from_rad(entering(entry, random));
        const Vec2 place = point_on(entry, sets.along_m[i], shape.cell_m);
        const CellExit out = cross_cell({place, Direction::of(heading)}, command, shape);
        if (out.on_corner(shape.cell_m)) continue;
        EXPECT_TRUE(sets.theta_of(entry, out.side)[i].holds(heading.rad(), 1e-6));
        for (const Side other : all_sides) {
          EXPECT_TRUE(other == out.side ||
                      !sets.theta_of(entry, other)[i].holds(heading.rad(), -1e-6));
        }
      }
    }
  }
}

TEST(CellSets, HaveTheForwardSetsOfTheirPlaces) {
  const CellShape shape{8.0, 20.0};
  const Direction command = Direction::of(Heading::from_rad(2.0));
  const CellSets sets = compute_cell_sets(command, shape, 4);
  EXPECT_EQ(sets.along_m, (std::vector<double>{1.0, 3.0, 5.0, 7.0}));
  for (const Side entry : all_sides) {
    for (const Side exit : all_sides) {
      for (std::size_t i = 0; i < 4; ++i) {
        const HeadingSet direct = forward_headings(entry, exit, sets.along_m[i], command, shape);
        const HeadingSet& listed = sets.phi_of(entry, exit)[i];
        ASSERT_EQ(listed.count, direct.count);
        for (std::size_t k = 0; k < direct.count; ++k) {
          EXPECT_EQ(listed.ranges[k].from_rad, direct.ranges[k].from_rad);
          EXPECT_EQ(listed.ranges[k].width_rad, direct.ranges[k].width_rad);
        }
      }
    }
  }
}

TEST(CellSets, NeedAPlaceAndACellSmallerThanATurn) {
  EXPECT_THROW((void)compute_cell_sets(Direction::none(), {8.0, 20.0}, 0), PreconditionViolation);
  EXPECT_THROW((void)compute_cell_sets(Direction::none(), {8.0, 8.0}, 1), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
