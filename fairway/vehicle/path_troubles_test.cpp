#include "fairway/vehicle/path_troubles.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

using Kind = PathTrouble::Kind;

std::vector<Kind> kinds_of(const PathMission& path, double turn_radius_m) {
  std::vector<Kind> kinds;
  for (const PathTrouble& t : path_troubles(path, turn_radius_m)) {
    EXPECT_FALSE(t.message.empty());
    EXPECT_LT(std::max(t.first_vertex, t.last_vertex), path.vertices_m.size()) << t.message;
    kinds.push_back(t.kind);
  }
  return kinds;
}

std::string told(const PathMission& path, double turn_radius_m) {
  std::string text;
  for (const PathTrouble& t : path_troubles(path, turn_radius_m)) text += t.message + "\n";
  return text;
}

/// Points of a circle, unevenly sampled; `part` of it.
PathMission circle(double radius_m, int count, double part, bool closed, Random& random) {
  std::vector<double> at;
  for (int k = 0; k < count; ++k) at.push_back(random.unit());
  at.push_back(0.0);
  if (!closed) at.push_back(1.0);
  std::sort(at.begin(), at.end());
  PathMission path;
  path.closed = closed;
  const Vec2 center{random.uniform(-500.0, 500.0), random.uniform(-500.0, 500.0)};
  const double begin = random.uniform(-pi, pi);
  const double way = random.below(2) == 0 ? part : -part;
  for (const double t : at) {
    const double angle = begin + two_pi * way * t;
    path.vertices_m.push_back(center + radius_m * Vec2{std::cos(angle), std::sin(angle)});
  }
  return path;
}

TEST(PathTroubles, ASmoothCurveWiderThanTheTurningRadiusHasNoneHoweverItIsSampled) {
  Random random(31);
  for (int draw = 0; draw < 300; ++draw) {
    const bool closed = draw % 2 == 0;
    const double radius_m = random.uniform(22.0, 300.0);
    const PathMission path =
        circle(radius_m, 400, closed ? 1.0 : random.uniform(0.3, 0.95), closed, random);
    EXPECT_EQ(told(path, 20.0), "") << "draw " << draw << ", radius " << radius_m;
  }
}

TEST(PathTroubles, ASmoothCurveNarrowerThanTheTurningRadiusIsTold) {
  Random random(32);
  for (int draw = 0; draw < 200; ++draw) {
    // Beyond three quarters of the circle straight parts, so that it does not fit into a turn.
    PathMission path = circle(random.uniform(5.0, 17.0), 300, 0.7, false, random);
    const auto& v = path.vertices_m;
    const Vec2 on = v[v.size() - 1] - v[v.size() - 2];
    path.vertices_m.push_back(v.back() + (100.0 / norm(on)) * on);
    EXPECT_NE(told(path, 20.0), "") << "draw " << draw;
  }
}

TEST(PathTroubles, LegsTooShortForTheTurnsAtTheirEndsAreToldWithMetres) {
  // Two right angles: 20 m for each.
  const auto step = [](double leg_m) {
    return PathMission{{{0.0, 0.0}, {200.0, 0.0}, {200.0, leg_m}, {400.0, leg_m}}, false};
  };
  EXPECT_EQ(told(step(41.0), 20.0), "");
  EXPECT_EQ(kinds_of(step(30.0), 20.0), std::vector{Kind::short_leg});
  EXPECT_EQ(told(step(30.0), 20.0),
            "the leg from vertex 2 to 3 is too short for the turns at both ends: from (200, 0) on "
            "there are 30 m where a turning radius of 20 m takes 40 m\n");
  const PathMission stairs{
      {{0.0, 0.0}, {200.0, 0.0}, {200.0, 30.0}, {230.0, 30.0}, {230.0, 62.0}, {400.0, 62.0}},
      false};
  EXPECT_EQ(told(stairs, 20.0),
            "the 3 legs from vertex 2 to 5 are too short for the turns at both ends: from (200, 0) "
            "on there are 30 m where a turning radius of 20 m takes 40 m\n");
}

TEST(PathTroubles, AVertexThatCannotBeRoundedIsTold) {
  const PathMission hairpin{{{0.0, 0.0}, {200.0, 0.0}, {0.0, 20.0}}, false};
  ASSERT_EQ(kinds_of(hairpin, 20.0), std::vector{Kind::sharp_vertex});
  EXPECT_EQ(told(hairpin, 20.0),
            "vertex 2 at (200, 0) turns by 174 degrees and cannot be rounded with a turning radius "
            "of 20 m: that takes 401 m of the legs on both sides, and one of them has 200 m\n");
  EXPECT_EQ(told(hairpin, 5.0), "");
  // Short legs at the ends of an open path, and at the join of a closed one.
  const PathMission end{{{0.0, 0.0}, {200.0, 0.0}, {200.0, 10.0}}, false};
  EXPECT_EQ(kinds_of(end, 20.0), std::vector{Kind::sharp_vertex});
  EXPECT_EQ(path_troubles(end, 20.0).front().first_vertex, 1U);
  const PathMission join{{{0.0, 0.0}, {300.0, 0.0}, {300.0, 200.0}, {0.0, 8.0}}, true};
  EXPECT_NE(told(join, 20.0), "");
  const PathMission square{{{0.0, 0.0}, {200.0, 0.0}, {200.0, 200.0}, {0.0, 200.0}}, true};
  EXPECT_EQ(told(square, 20.0), "");
  EXPECT_EQ(told(square, 99.0), "");
  EXPECT_NE(told(square, 130.0), "");
}

TEST(PathTroubles, APathThatRunsBackOverItselfIsToldTwiceOver) {
  const PathMission back{{{0.0, 0.0}, {200.0, 0.0}, {100.0, 0.0}, {100.0, 150.0}}, false};
  const std::vector<Kind> kinds = kinds_of(back, 20.0);
  EXPECT_EQ(kinds, (std::vector{Kind::sharp_vertex, Kind::crossing}));
}

TEST(PathTroubles, VerticesOnALineAndSmallJitterAreNone) {
  Random random(33);
  PathMission path;
  for (int k = 0; k <= 300; ++k) path.vertices_m.push_back({1.0 * k, 0.0});
  EXPECT_EQ(told(path, 20.0), "");
  for (Vec2& v : path.vertices_m) v.y += random.uniform(-0.15, 0.15);
  EXPECT_EQ(told(path, 20.0), "");
}

TEST(PathTroubles, APathInsideATurningCircleIsTold) {
  const PathMission path{{{10.0, 5.0}, {40.0, 5.0}}, false};
  EXPECT_EQ(kinds_of(path, 20.0), std::vector{Kind::fits_into_a_turn});
  EXPECT_EQ(told(path, 14.0), "");
  const PathMission ring{{{0.0, 0.0}, {12.0, 0.0}, {12.0, 12.0}, {0.0, 12.0}}, true};
  EXPECT_EQ(kinds_of(ring, 20.0).front(), Kind::fits_into_a_turn);
}

TEST(PathTroubles, AFigureOfEightIsToldWithThePlaceWhereItMeetsItself) {
  const PathMission eight{{{0.0, 0.0}, {300.0, 300.0}, {300.0, 0.0}, {0.0, 300.0}}, true};
  EXPECT_EQ(kinds_of(eight, 20.0), std::vector{Kind::crossing});
  EXPECT_EQ(told(eight, 20.0),
            "the path meets itself at (150, 150), where the legs from vertex 1 to 2 and from "
            "vertex 3 to 4 have a point in common: a cell has one command, so that flights leave "
            "parts of the path out\n");
}

TEST(PathCrossings, AreThoseOfAllPairsOfPieces) {
  Random random(34);
  std::size_t met = 0;
  for (int draw = 0; draw < 300; ++draw) {
    PathMission path;
    path.closed = draw % 2 == 0;
    for (int k = 0; k < 12; ++k) {
      path.vertices_m.push_back({random.uniform(0.0, 100.0), random.uniform(0.0, 100.0)});
    }
    const auto& v = path.vertices_m;
    const std::size_t pieces = path.closed ? 12 : 11;
    std::vector<std::pair<std::size_t, std::size_t>> expected;
    const auto left = [](Vec2 a, Vec2 b, Vec2 p) { return cross(b - a, p - a) > 0.0; };
    for (std::size_t i = 0; i < pieces; ++i) {
      for (std::size_t j = i + 2; j < pieces; ++j) {
        if (path.closed && i == 0 && j + 1 == pieces) continue;
        const Vec2 a = v[i], b = v[i + 1], c = v[j], d = v[(j + 1) % 12];
        if (left(a, b, c) != left(a, b, d) && left(c, d, a) != left(c, d, b)) {
          expected.emplace_back(i, j);
        }
      }
    }
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (const PathCrossing& c : path_crossings(path)) {
      found.emplace_back(c.first_piece, c.second_piece);
      for (const std::size_t k : {c.first_piece, c.second_piece}) {
        const Vec2 u = v[(k + 1) % 12] - v[k];
        EXPECT_NEAR(cross(u, c.position_m - v[k]) / norm(u), 0.0, 1e-9);
      }
    }
    EXPECT_EQ(found, expected) << "draw " << draw;
    met += found.size();
  }
  EXPECT_GT(met, 1000U);
}

TEST(PathCrossings, TouchesAndSharedStretchesCountNeighboursDoNot) {
  const PathMission touch{{{0.0, 0.0}, {100.0, 0.0}, {100.0, 50.0}, {50.0, 0.0}}, false};
  ASSERT_EQ(path_crossings(touch).size(), 1U);
  EXPECT_EQ(path_crossings(touch).front().position_m, (Vec2{50.0, 0.0}));
  const PathMission line{{{0.0, 0.0}, {100.0, 0.0}, {200.0, 0.0}, {200.0, 0.0}, {300.0, 1.0}},
                         false};
  EXPECT_TRUE(path_crossings(line).empty());
  const PathMission triangle{{{0.0, 0.0}, {100.0, 0.0}, {50.0, 80.0}}, true};
  EXPECT_TRUE(path_crossings(triangle).empty());
  const PathMission out_and_back{{{0.0, 0.0}, {100.0, 0.0}}, true};
  EXPECT_EQ(path_crossings(out_and_back).size(), 1U);
}

TEST(PathTroubles, AreForAPathAndAVehicle) {
  EXPECT_THROW((void)path_troubles({{{0.0, 0.0}}, false}, 20.0), PreconditionViolation);
  EXPECT_THROW((void)path_troubles({{{0.0, 0.0}, {1.0, 0.0}}, false}, 0.0), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
