#include "fairway/field/transition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/heading.hpp"
#include "fairway/field/cost_to_go.hpp"
#include "fairway/field/distance_transform.hpp"
#include "fairway/field/raw_field.hpp"
#include "fairway/field/testing/sample_maps.hpp"

namespace fairway {
namespace {

using samples::Mask;

constexpr Vehicle vehicle{10.0, 6.0};
constexpr float pi_f = static_cast<float>(pi);

// Eq. 16 in double, and what Blend::continuous makes of it.
double equation_16(double ratio, double angle_rad, double mu, Blend blend) {
  const double a = mu * ratio * angle_rad / pi;
  return blend == Blend::paper ? a : a + (1.0 - a) * std::pow(ratio, 1.0 / mu);
}

// --- The share of the turn -----------------------------------------------------------------------

RC_GTEST_PROP(TransitionShare, IsOneMinusAOfEquation16, ()) {
  const auto unit = [] { return *rc::gen::inRange(0, 1001) / 1000.0; };
  const double ratio = unit();
  const double angle = pi * unit();
  const double mu = 0.001 + 0.999 * unit();
  for (const Blend blend : {Blend::paper, Blend::continuous}) {
    const float share = transition_share(static_cast<float>(ratio), static_cast<float>(angle),
                                         static_cast<float>(mu), blend);
    RC_ASSERT(std::fabs(share - (1.0 - equation_16(ratio, angle, mu, blend))) < 2e-5);
    RC_ASSERT(share >= -1e-6F && share <= 1.0F);
  }
}

TEST(TransitionShare, AtTheEdgeTheFieldIsTheEdgesWhateverMu) {
  for (const float mu : {0.01F, 0.5F, 1.0F}) {
    for (const float angle : {0.0F, 1.0F, pi_f}) {
      EXPECT_EQ(transition_share(0.0F, angle, mu, Blend::paper), 1.0F);
      EXPECT_EQ(transition_share(0.0F, angle, mu, Blend::continuous), 1.0F);
    }
  }
}

TEST(TransitionShare, AtTheRimThePapersBlendJumpsAndTheContinuousOneDoesNot) {
  for (const float mu : {0.1F, 0.5F, 1.0F}) {
    for (const float angle : {0.0F, 0.1F, 1.0F, 3.0F}) {
      EXPECT_GT(transition_share(1.0F, angle, mu, Blend::paper), 0.04F);
      EXPECT_EQ(transition_share(1.0F, angle, mu, Blend::continuous), 0.0F);
      EXPECT_LT(transition_share(0.9999F, angle, mu, Blend::continuous), 2e-3F);
    }
  }
  // The paper's rotation vanishes at the rim in one case only: mu = 1 and opposite directions.
  EXPECT_NEAR(transition_share(1.0F, pi_f, 1.0F, Blend::paper), 0.0F, 1e-6F);
}

TEST(TransitionShare, TheSmallerMuTheSoonerTheFlowIsParallel) {
  for (const Blend blend : {Blend::paper, Blend::continuous}) {
    for (const float ratio : {0.1F, 0.5F, 0.9F}) {
      float before = 1.1F;
      for (const float mu : {0.01F, 0.2F, 0.5F, 0.8F, 1.0F}) {
        const float share = transition_share(ratio, 2.0F, mu, blend);
        EXPECT_LT(share, before);
        before = share;
      }
    }
  }
}

TEST(TransitionShare, FallsWithTheDistance) {
  for (const Blend blend : {Blend::paper, Blend::continuous}) {
    for (const float mu : {0.05F, 0.5F, 1.0F}) {
      float before = 1.0F;
      for (int k = 1; k <= 100; ++k) {
        const float share = transition_share(static_cast<float>(k) / 100.0F, 1.5F, mu, blend);
        EXPECT_LE(share, before);
        before = share;
      }
      EXPECT_LT(before, 1.0F);
    }
  }
}

// --- The field -----------------------------------------------------------------------------------

struct Scene {
  Grid grid;
  CompleteMap complete;
  BufferBorder border;
  VectorField raw;
};

Scene scene_of(const ObstacleMap& map, const Mission& mission) {
  FieldOptions options;
  options.alpha = 1.0;
  options.beta = 1.0;
  auto found = complete_map(map, vehicle, mission, options);
  const auto* refusal = std::get_if<MissionRefusal>(&found);
  if (refusal != nullptr) throw std::runtime_error(refusal->message);
  Scene s{map.grid, std::get<CompleteMap>(std::move(found)), {}, {}};
  std::vector<float> cost = cost_to_go(s.grid, s.complete, mission, Metric::euclidean);
  s.border = buffer_border(s.grid, s.complete.region, cost);
  s.raw = raw_field(s.grid, s.complete, mission, Metric::euclidean, cost, s.border);
  return s;
}

ObstacleMap blob_map(Random& random) {
  Mask m = samples::blobs(random, 80, 70, 8, 4.0);
  for (int iy = 22; iy < 50; ++iy) {
    for (int ix = 22; ix < 60; ++ix) m.at(ix, iy) = 0;
  }
  return samples::map_of(m, 1.5, 10.0, -20.0);
}

const GoalMission goal{{68.0, 33.0}, {}};
const PathMission path{{{60.0, 25.0}, {82.0, 30.0}, {81.0, 40.0}, {62.0, 42.0}}, true};

// Eqs. 13 to 17 for one cell and one edge cell, with angles, the turn of Eq. 15 towards the edge.
double equation_13(double theta_c, double theta_e, double distance_m, double sigma_r_m, double mu,
                   Blend blend) {
  if (distance_m > sigma_r_m) return theta_c;
  const double delta = Heading::from_rad(theta_c).turn_to(Heading::from_rad(theta_e));
  const double a = equation_16(distance_m / sigma_r_m, std::fabs(delta), mu, blend);
  return theta_c + (1.0 - a) * delta;
}

double gap(double a, double b) {
  return std::fabs(Heading::from_rad(a).turn_to(Heading::from_rad(b)));
}

void expect_equations(const Scene& s, const FieldOptions& options, std::size_t& turned_left,
                      std::size_t& turned_right) {
  const VectorField found = transition_field(s.grid, s.complete, s.border, s.raw, vehicle, options);
  const double r = vehicle.turn_radius_m;
  for (std::size_t i = 0; i < s.grid.size(); ++i) {
    if (s.complete.region[i] == Region::obstacle || (s.raw.x[i] == 0.0F && s.raw.y[i] == 0.0F)) {
      ASSERT_EQ(found.x[i], s.raw.x[i]);
      ASSERT_EQ(found.y[i], s.raw.y[i]);
      continue;
    }
    const auto center = [&](std::size_t k) { return s.grid.center(s.grid.cell_at(k)); };
    const auto theta = [&](std::size_t k) { return std::atan2(s.raw.y[k], s.raw.x[k]); };
    const double now = std::atan2(found.y[i], found.x[i]);
    // The nearest edge cells, of one kind or the other; of equally near ones any may count.
    double path_m = std::numeric_limits<double>::infinity();
    double border_m = std::numeric_limits<double>::infinity();
    if (options.sigma_path > 0.0) {
      for (const PathCell& c : s.complete.path_cells) {
        path_m = std::min(path_m, norm(center(c.index) - center(i)));
      }
    }
    if (options.sigma_border > 0.0 && s.border.nearest[i] != no_feature) {
      border_m = norm(center(s.border.nearest[i]) - center(i));
    }
    double least = pi;
    const auto offer = [&](std::size_t edge, double distance_m, double sigma, double mu) {
      const double angle = edge == i ? 0.0 : gap(theta(edge), theta(i));
      double expected =
          edge == i ? theta(i)
                    : equation_13(theta(i), theta(edge), distance_m, sigma * r, mu, options.blend);
      double miss = gap(now, expected);
      if (angle > pi - 1e-3) {  // opposite directions turn either way
        miss = std::min(miss, gap(now, 2.0 * theta(i) - expected));
      }
      least = std::min(least, miss);
    };
    if (path_m <= border_m + 1e-9 && std::isfinite(path_m)) {
      for (const PathCell& c : s.complete.path_cells) {
        if (norm(center(c.index) - center(i)) > path_m + 1e-9) continue;
        offer(c.index, path_m, options.sigma_path, options.mu_path);
      }
    }
    if (border_m <= path_m + 1e-9 && std::isfinite(border_m)) {
      offer(s.border.nearest[i], border_m, options.sigma_border, options.mu_border);
    }
    if (!std::isfinite(std::min(path_m, border_m))) least = gap(now, theta(i));
    ASSERT_LT(least, 2e-3) << "cell " << i << " of region "
                           << static_cast<int>(s.complete.region[i]);
    ASSERT_NEAR(std::hypot(found.x[i], found.y[i]), 1.0, 1e-5);
    const double turn = Heading::from_rad(theta(i)).turn_to(Heading::from_rad(now));
    turned_left += turn > 0.01 ? 1 : 0;
    turned_right += turn < -0.01 ? 1 : 0;
  }
}

TEST(TransitionField, FollowsEquations13To17CellByCell) {
  Random random(111);
  std::size_t left = 0;
  std::size_t right = 0;
  for (int draw = 0; draw < 8; ++draw) {
    const ObstacleMap map = blob_map(random);
    for (const Mission& mission : {Mission{goal}, Mission{path}}) {
      const Scene s = scene_of(map, mission);
      FieldOptions options;
      options.blend = draw % 2 == 0 ? Blend::paper : Blend::continuous;
      options.mu_path = random.uniform(0.05, 1.0);
      options.mu_border = random.uniform(0.05, 1.0);
      options.sigma_path = random.uniform(0.2, 2.0);
      options.sigma_border = random.uniform(0.2, 2.0);
      expect_equations(s, options, left, right);
      if (testing::Test::HasFatalFailure()) FAIL() << "draw " << draw;
    }
  }
  EXPECT_GT(left, 1000U);
  EXPECT_GT(right, 1000U);
}

// One row: the edge is the path cell at the west end; every cell has its own direction.
VectorField turned_in_a_row(const std::vector<double>& theta, FieldOptions options) {
  Scene s;
  const auto n = static_cast<int>(theta.size());
  s.grid = {n, 1, 0.0, 0.0, 1.0};
  s.complete.region.assign(theta.size(), Region::free);
  s.complete.region[0] = Region::goal;
  s.complete.goal_cells = {0};
  s.complete.path_cells = {{0, {std::cos(theta[0]), std::sin(theta[0])}, 0.0}};
  s.border.nearest.assign(theta.size(), no_feature);
  s.raw = VectorField(theta.size());
  for (std::size_t i = 0; i < theta.size(); ++i) {
    s.raw.x[i] = static_cast<float>(std::cos(theta[i]));
    s.raw.y[i] = static_cast<float>(std::sin(theta[i]));
  }
  return transition_field(s.grid, s.complete, s.border, s.raw, vehicle, options);
}

TEST(TransitionField, BothSensesTurnTowardsTheEdgesDirectionAcrossTheCutAtPiToo) {
  FieldOptions options;
  options.sigma_path = 1.0;
  options.mu_path = 0.5;
  for (const Blend blend : {Blend::paper, Blend::continuous}) {
    options.blend = blend;
    for (const double edge : {0.0, 1.0, 3.0, -3.1, pi, -pi / 2}) {
      for (const double off : {-3.0, -1.5, -0.2, 0.2, 1.5, 3.0}) {
        const VectorField found = turned_in_a_row({edge, edge + off, edge + off}, options);
        for (const std::size_t i : {1U, 2U}) {
          const double now = std::atan2(found.y[i], found.x[i]);
          const double expected =
              equation_13(edge + off, edge, static_cast<double>(i), 6.0, 0.5, blend);
          EXPECT_NEAR(gap(now, expected), 0.0, 1e-3) << "edge " << edge << ", off by " << off;
          EXPECT_LT(gap(now, edge), std::fabs(off) - 0.1 * std::fabs(off))
              << "away from the edge's direction: edge " << edge << ", off by " << off;
        }
      }
    }
  }
}

TEST(TransitionField, ContinuousFallsToZeroAtTheRimWhereThePaperJumps) {
  // 60 cells across the transition of one turning radius at 1/10 m cells.
  constexpr int n = 130;
  Scene s;
  s.grid = {n, 1, 0.0, 0.0, 0.1};
  s.complete.region.assign(n, Region::free);
  s.complete.path_cells = {{0, {1.0, 0.0}, 0.0}};
  s.border.nearest.assign(n, no_feature);
  s.raw = VectorField(n);
  for (std::size_t i = 0; i < n; ++i) s.raw.y[i] = i == 0 ? 0.0F : 1.0F;
  s.raw.x[0] = 1.0F;
  FieldOptions options;
  options.sigma_path = 1.0;
  options.mu_path = 0.5;
  const auto jump = [&](Blend blend) {
    options.blend = blend;
    const VectorField f = transition_field(s.grid, s.complete, s.border, s.raw, vehicle, options);
    double largest = 0.0;
    for (std::size_t i = 1; i < n; ++i) {
      largest =
          std::max(largest, gap(std::atan2(f.y[i], f.x[i]), std::atan2(f.y[i - 1], f.x[i - 1])));
    }
    EXPECT_EQ(f.x[70], 0.0F);  // beyond the rim nothing turns
    EXPECT_EQ(f.y[70], 1.0F);
    return largest;
  };
  EXPECT_NEAR(jump(Blend::paper), 0.75 * pi / 2, 0.02);  // a = mu / 2 at the rim
  EXPECT_LT(jump(Blend::continuous), 0.08);
}

TEST(TransitionField, FadesOutAtTheEndOfAnOpenPathUnlessThePapersBlendIsUsed) {
  const ObstacleMap map = samples::map_of(Mask(60, 50), 1.5);
  const PathMission open{{{20.0, 40.0}, {60.0, 40.0}}, false};
  const Scene s = scene_of(map, open);
  for (const Blend blend : {Blend::paper, Blend::continuous}) {
    FieldOptions options;
    options.sigma_path = 2.0;
    options.blend = blend;
    const VectorField found =
        transition_field(s.grid, s.complete, s.border, s.raw, vehicle, options);
    const auto turned = [&](Vec2 at) {
      const std::size_t i = s.grid.index(s.grid.cell_of(at));
      return gap(std::atan2(found.y[i], found.x[i]), std::atan2(s.raw.y[i], s.raw.x[i])) > 1e-3;
    };
    const bool paper = blend == Blend::paper;
    for (const double aside_m : {-6.0, -3.0, 3.0, 6.0}) {
      EXPECT_TRUE(turned({40.0, 40.0 + aside_m}));
      EXPECT_TRUE(turned({18.0, 40.0 + aside_m}));  // before its first vertex
      EXPECT_EQ(turned({61.5, 40.0 + aside_m}), paper);
      EXPECT_EQ(turned({66.0, 40.0 + aside_m}), paper);
    }
  }
}

TEST(ShareNearOpenEnd, RisesFromZeroACellFromTheEndToOneHalfARadiusFarther) {
  EXPECT_EQ(share_near_open_end(0.0, 2.0, 20.0), 0.0F);
  EXPECT_EQ(share_near_open_end(2.0, 2.0, 20.0), 0.0F);
  EXPECT_FLOAT_EQ(share_near_open_end(7.0, 2.0, 20.0), 0.5F);
  EXPECT_EQ(share_near_open_end(12.0, 2.0, 20.0), 1.0F);
  EXPECT_EQ(share_near_open_end(std::numeric_limits<double>::infinity(), 2.0, 20.0), 1.0F);
}

TEST(TransitionField, WithoutWidthsNothingChangesAndOneWidthLeavesTheOtherAlone) {
  Random random(112);
  const Scene s = scene_of(blob_map(random), path);
  FieldOptions options;
  options.sigma_path = 0.0;
  options.sigma_border = 0.0;
  const VectorField none = transition_field(s.grid, s.complete, s.border, s.raw, vehicle, options);
  EXPECT_EQ(none.x, s.raw.x);
  EXPECT_EQ(none.y, s.raw.y);
  std::size_t left = 0;
  std::size_t right = 0;
  for (const bool at_path : {true, false}) {
    options.sigma_path = at_path ? 1.0 : 0.0;
    options.sigma_border = at_path ? 0.0 : 1.0;
    expect_equations(s, options, left, right);
  }
}

TEST(TransitionField, DoesNotDependOnTheNumberOfThreads) {
  Random random(113);
  Mask m = samples::blobs(random, 300, 260, 12, 8.0);
  for (int iy = 0; iy < 60; ++iy) {
    for (int ix = 0; ix < 80; ++ix) m.at(ix, iy) = 0;
  }
  const Scene s = scene_of(samples::map_of(m, 1.5), GoalMission{{50.0, 40.0}, {}});
  const auto turned = [&] {
    FieldOptions options;
    options.sigma_border = 2.0;
    return transition_field(s.grid, s.complete, s.border, s.raw, vehicle, options);
  };
  const VectorField one = samples::on_threads(1, turned);
  const VectorField two = samples::on_threads(2, turned);
  EXPECT_EQ(one.x, two.x);
  EXPECT_EQ(one.y, two.y);
}

}  // namespace
}  // namespace fairway
