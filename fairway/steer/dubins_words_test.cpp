#include "fairway/steer/dubins_words.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/steer/testing/dubins_oracle.hpp"

namespace fairway {
namespace {

using oracle::random_pose;
using oracle::Real;

State pose(double x, double y, double h) { return {{x, y}, Heading::from_rad(h)}; }
State mirrored(const State& s) { return pose(s.position_m.x, -s.position_m.y, -s.heading.rad()); }
State reversed(const State& s) { return {s.position_m, s.heading.opposite()}; }

std::string shown(const State& a, const State& b, double r) {
  char text[300];
  std::snprintf(text, sizeof text, "from %.17g,%.17g,%.17g to %.17g,%.17g,%.17g r %.17g",
                a.position_m.x, a.position_m.y, a.heading.rad(), b.position_m.x, b.position_m.y,
                b.heading.rad(), r);
  return text;
}

/// The end of a path, integrated in long double from its parts alone: how far from the goal, in
/// units of (r + distance), and the larger of that and the heading's error in radians.
Real end_error(const DubinsPath& path, const State& to) {
  const Real r = path.turn_radius_m;
  const Real h0 = path.start.heading.rad();
  Real x = 0.0L, y = 0.0L, h = h0;
  for (int i = 0; i < 3; ++i) {
    const Real part = path.part_m[static_cast<std::size_t>(i)];
    const int turn = turn_of(path.word, i);
    if (turn == 0) {
      x += part * std::cos(h);
      y += part * std::sin(h);
    } else {
      const Real next = h + turn * part / r;
      x += turn * r * (std::sin(next) - std::sin(h));
      y -= turn * r * (std::cos(next) - std::cos(h));
      h = next;
    }
  }
  const Real dx = static_cast<Real>(to.position_m.x) - path.start.position_m.x;
  const Real dy = static_cast<Real>(to.position_m.y) - path.start.position_m.y;
  const Real place = std::hypot(x - dx, y - dy) / (r + std::hypot(dx, dy));
  const Real heading = std::abs(std::remainder(h - to.heading.rad(), oracle::circle));
  return std::max(place, heading);
}

/// What must hold for any pair. The oracle's `slack` makes it forgive a whole turn that is one by
/// rounding only; the least over several slacks is what the allowance of property 3 permits.
void check(const State& a, const State& b, double r) {
  const DubinsPath path = shortest_path(a, b, r);
  const double length_m = shortest_length_m(a, b, r);
  const double distance_m = norm(b.position_m - a.position_m);
  ASSERT_TRUE(std::isfinite(length_m)) << shown(a, b, r);
  ASSERT_NEAR(path.length_m(), length_m, 2e-14 * (r + distance_m) + 2e-15 * length_m)
      << shown(a, b, r);
  ASSERT_LE(end_error(path, b), 1e-12L) << shown(a, b, r) << ' ' << name_of(path.word);
  for (const double part_m : path.part_m) ASSERT_GE(part_m, 0.0) << shown(a, b, r);
  for (const int i : {0, 2}) {
    ASSERT_LT(path.part_m[static_cast<std::size_t>(i)], two_pi * r * (1.0 + 1e-15))
        << shown(a, b, r);
  }
  ASSERT_GE(length_m, distance_m - 2e-13 * (r + distance_m)) << shown(a, b, r);
}

TEST(ShortestPath, HasTheLeastLengthOfTheSixWordsForRandomPoses) {
  for (const double size : {0.01, 1.0, 4.0, 40.0, 4000.0}) {
    Random random(7);
    for (int i = 0; i < 100'000; ++i) {
      const double r = i % 2 == 0 ? 1.0 : std::exp(random.uniform(-3.0, 7.0));
      const State a = random_pose(random, size * r);
      const State b = random_pose(random, size * r);
      check(a, b, r);
      const auto least = static_cast<double>(oracle::least(oracle::lengths(a, b, r, 0.0L)) * r);
      ASSERT_NEAR(shortest_length_m(a, b, r), least,
                  1e-12 * (r + norm(b.position_m - a.position_m)))
          << shown(a, b, r);
    }
  }
}

/// Where turns vanish, circles touch or coincide, headings are equal or opposite, up to rounding.
std::vector<State> degenerate_goals(const State& a, double r, Random& random) {
  std::vector<State> goals;
  const std::array<double, 8> turns{0.0, pi / 2, pi, 3 * pi / 2, 1e-8, 1e-4, 1.0, 6.0};
  const std::array<double, 6> lengths{0.0, 1e-9, 1e-3, 1.0, 4.0, 30.0};
  for (const double first : turns) {
    for (const double length : lengths) {
      for (const double last : {0.0, 1e-8, 1.0, pi, 5.0}) {
        for (int signs = 0; signs < 4; ++signs) {
          const double k0 = signs & 1 ? 1.0 : -1.0;
          const double k1 = signs & 2 ? 1.0 : -1.0;
          goals.push_back(
              driven(driven(driven(a, first * r, k0 / r), length * r, 0.0), last * r, k1 / r));
        }
      }
    }
  }
  goals.push_back(a);
  for (const double x : {-2.0, -1.0, 0.0, 1.0, 2.0, 4.0}) {  // tangencies, U-turns
    for (const double y : {-4.0, -2.0, 0.0, 2.0, 4.0}) {
      for (const double turn : {0.0, pi / 2, pi, -pi / 2}) {
        const Vec2 u = a.heading.unit();
        goals.push_back({a.position_m + (x * r) * u + (y * r) * left_of(u),
                         Heading::from_rad(a.heading.rad() + turn)});
      }
    }
  }
  const std::size_t exact = goals.size();
  for (std::size_t i = 0; i < exact; ++i) {  // and next to them
    const double off = std::pow(10.0, random.uniform(-16.0, -6.0)) * r;
    State s = goals[i];
    s.position_m = s.position_m + Vec2{off * random.uniform(-1, 1), off * random.uniform(-1, 1)};
    s.heading = Heading::from_rad(s.heading.rad() + off / r * random.uniform(-1, 1));
    goals.push_back(s);
  }
  return goals;
}

TEST(ShortestPath, HasTheLeastLengthAtAndBesideDegeneratePlaces) {
  Random random(3);
  for (int k = 0; k < 60; ++k) {
    const double r = k % 3 == 0 ? 1.0 : std::exp(random.uniform(-3.0, 7.0));
    const State a = k % 2 == 0 ? pose(0, 0, (k % 8) * pi / 4) : random_pose(random, 40.0 * r);
    for (const State& b : degenerate_goals(a, r, random)) {
      check(a, b, r);
      // Never longer than the exact least of these very doubles. Where it is shorter by a loop, its
      // end, checked above, is still the goal: property 3.
      const auto strict = static_cast<double>(oracle::least(oracle::lengths(a, b, r, 0.0L)) * r);
      const double ours = shortest_length_m(a, b, r);
      const double unit = r + norm(b.position_m - a.position_m);
      ASSERT_LE(ours, strict + 1e-12 * unit) << shown(a, b, r);
    }
  }
}

TEST(ShortestPath, IsNeverALoopTooLongWhereAPathIsKnown) {
  // Goals made by driving two parts: nothing shorter than the drive may be missed, and no loop
  // appears where a turn of it is nothing.
  Random random(11);
  for (int i = 0; i < 300'000; ++i) {
    const double r = std::exp(random.uniform(-2.0, 6.0));
    const State a = random_pose(random, 40.0 * r);
    const double turn = i % 3 == 0 ? 0.0 : random.uniform(0.0, 2 * pi);
    const double length = i % 5 == 0 ? 0.0 : random.uniform(0.0, 10.0);
    const double k = i % 2 == 0 ? 1.0 : -1.0;
    const State straight_last = driven(driven(a, turn * r, k / r), length * r, 0.0);
    const State turn_last = driven(driven(a, length * r, 0.0), turn * r, k / r);
    const State two_turns = driven(driven(a, turn * r, k / r), 0.2 * length * r, -k / r);
    ASSERT_LE(shortest_length_m(a, straight_last, r), (turn + length) * r * (1 + 1e-11));
    ASSERT_LE(shortest_length_m(a, turn_last, r), (turn + length) * r * (1 + 1e-11));
    ASSERT_LE(shortest_length_m(a, two_turns, r), (turn + 0.2 * length) * r * (1 + 1e-11));
  }
}

TEST(ShortestPath, HasTheseLengthsComputedByHand) {
  const State a = pose(0, 0, 0);
  EXPECT_EQ(shortest_length_m(a, a, 1.0), 0.0);
  EXPECT_EQ(shortest_length_m(a, pose(7, 0, 0), 2.0), 7.0);
  EXPECT_NEAR(shortest_length_m(a, pose(1, 1, pi / 2), 1.0), pi / 2, 1e-15);
  EXPECT_NEAR(shortest_length_m(a, pose(0, 2, pi), 1.0), pi, 1e-15);
  EXPECT_NEAR(shortest_length_m(a, pose(1, -1, -pi / 2), 1.0), pi / 2, 1e-15);
  EXPECT_NEAR(shortest_length_m(a, pose(0, 1, pi / 2), 1.0), 1.0 + 1.5 * pi + pi, 3.0);
  // Turn round on the spot: left 60, right 300, left 60 degrees.
  EXPECT_NEAR(shortest_length_m(a, pose(0, 0, pi), 1.0), 7.0 / 3.0 * pi, 1e-14);
  // Straight back by 2: nothing is shorter than a whole turn and the rest.
  EXPECT_NEAR(shortest_length_m(a, pose(-10, 0, 0), 1.0), 2 * pi + 10.0, 1e-13);
}

TEST(ShortestPath, IsMirroredAndReversedWithItsPoses) {
  Random random(5);
  for (int i = 0; i < 100'000; ++i) {
    const State a = random_pose(random, 6.0);
    const State b = random_pose(random, 6.0);
    const double length = shortest_length_m(a, b, 1.0);
    ASSERT_NEAR(shortest_length_m(mirrored(a), mirrored(b), 1.0), length, 1e-13);
    ASSERT_NEAR(shortest_length_m(reversed(b), reversed(a), 1.0), length, 1e-13);
  }
}

TEST(ShortestPath, EveryWordsPathEndsAtTheGoal) {
  Random random(9);
  int found = 0;
  for (int i = 0; i < 100'000; ++i) {
    const State a = random_pose(random, 5.0);
    const State b = random_pose(random, 5.0);
    const auto all = oracle::lengths(a, b, 1.0, 0.0L);
    for (const DubinsWord word : dubins_words) {
      const auto path = path_of_word(word, a, b, 1.0);
      const Real expected = all[static_cast<std::size_t>(word)];
      ASSERT_EQ(path.has_value(), std::isfinite(expected)) << shown(a, b, 1.0) << name_of(word);
      if (!path) continue;
      ++found;
      ASSERT_LE(end_error(*path, b), 1e-12L) << shown(a, b, 1.0) << ' ' << name_of(word);
      ASSERT_NEAR(path->length_m(), static_cast<double>(expected), 1e-9) << name_of(word);
    }
  }
  EXPECT_GT(found, 300'000);
}

TEST(PoseAt, IsContinuousAndMovesByItsLength) {
  Random random(13);
  for (int i = 0; i < 2'000; ++i) {
    const double r = std::exp(random.uniform(-1.0, 4.0));
    const State a = random_pose(random, 8.0 * r);
    const State b = random_pose(random, 8.0 * r);
    const DubinsPath path = shortest_path(a, b, r);
    EXPECT_EQ(pose_at(path, 0.0), a);
    EXPECT_EQ(pose_at(path, path.length_m() * (1 + 1e-12)), end_of(path));
    const double step_m = path.length_m() / 500.0;
    State last = a;
    for (int k = 1; k <= 500; ++k) {
      const State s = pose_at(path, k * step_m);
      ASSERT_LE(norm(s.position_m - last.position_m), step_m * (1 + 1e-9));
      ASSERT_LE(std::abs(last.heading.turn_to(s.heading)), step_m / r * (1 + 1e-9) + 1e-14);
      // Half way between them the heading is that of the chord, to the order of the step cubed.
      last = s;
    }
    for (const State& s : sampled(path, 0.1 * r)) {
      ASSERT_LE(shortest_length_m(a, s, r), path.length_m() * (1 + 1e-9) + 1e-9 * r);
    }
  }
}

TEST(PoseAt, TheRestOfAShortestPathIsAShortestPath) {
  Random random(17);
  for (int i = 0; i < 20'000; ++i) {
    const State a = random_pose(random, 6.0);
    const State b = random_pose(random, 6.0);
    const DubinsPath path = shortest_path(a, b, 1.0);
    const double at = random.unit() * path.length_m();
    const double rest = shortest_length_m(pose_at(path, at), b, 1.0);
    ASSERT_NEAR(rest + at, path.length_m(), 1e-10) << shown(a, b, 1.0) << " at " << at;
  }
}

TEST(Batch, AgreesWithOneAtATime) {
  Random random(19);
  const double r = 3.0;
  std::vector<State> from;
  std::vector<State> to;
  for (int i = 0; i < 3'001; ++i) {
    from.push_back(random_pose(random, i % 2 == 0 ? 12.0 : 200.0));
    to.push_back(random_pose(random, i % 2 == 0 ? 12.0 : 200.0));
  }
  for (const State& goal : degenerate_goals(pose(1, 2, 3), r, random)) {
    from.push_back(pose(1, 2, 3));
    to.push_back(goal);
  }
  std::array<std::vector<double>, 6> columns;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const std::array<double, 6> row{from[i].position_m.x,  from[i].position_m.y,
                                    from[i].heading.rad(), to[i].position_m.x,
                                    to[i].position_m.y,    to[i].heading.rad()};
    for (std::size_t k = 0; k < 6; ++k) columns[k].push_back(row[k]);
  }
  std::vector<double> lengths(from.size());
  shortest_lengths_m({columns[0], columns[1], columns[2]}, {columns[3], columns[4], columns[5]}, r,
                     lengths);
  std::vector<DubinsPath> paths(from.size());
  shortest_paths(from, to, r, paths);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double unit = r + norm(to[i].position_m - from[i].position_m);
    const double alone = shortest_length_m(from[i], to[i], r);
    ASSERT_NEAR(lengths[i], alone, 4e-15 * unit) << shown(from[i], to[i], r);
    ASSERT_EQ(paths[i].length_m(), shortest_path(from[i], to[i], r).length_m());
  }
}

TEST(Batch, GivesNanForPairsThatCannotBeSteered) {
  const double nan = std::nan("");
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<double> x{nan, inf, 1e300, 0.0, 0.0, 1.0};
  const std::vector<double> h{0.0, 0.0, 0.0, nan, 9.0, 0.0};
  const std::vector<double> zero(6, 0.0);
  std::vector<double> lengths(6);
  shortest_lengths_m({x, zero, h}, {zero, zero, zero}, 1.0, lengths);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(std::isnan(lengths[static_cast<std::size_t>(i)])) << i;
  EXPECT_NEAR(lengths[5], 1.0 + two_pi, 1e-14);
}

TEST(ShortestPath, RefusesInvalidPosesAndRadii) {
  const State a = pose(0, 0, 0);
  const double inf = std::numeric_limits<double>::infinity();
  for (const double r : {0.0, -1.0, inf, std::nan(""), 1e-320}) {
    EXPECT_THROW(static_cast<void>(shortest_length_m(a, pose(1, 2, 3), r)), PreconditionViolation)
        << r;
  }
  for (const double x : {inf, -inf, std::nan(""), 1e200}) {
    EXPECT_THROW(static_cast<void>(shortest_path(a, pose(x, 0, 0), 1.0)), PreconditionViolation)
        << x;
    EXPECT_THROW(static_cast<void>(shortest_path(pose(0, x, 0), a, 1.0)), PreconditionViolation)
        << x;
  }
}

}  // namespace
}  // namespace fairway
