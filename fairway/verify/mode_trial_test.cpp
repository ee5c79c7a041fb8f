#include "fairway/verify/mode_trial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/verify/certify.hpp"
#include "fairway/verify/mode_choice.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

/// A channel with its goal at the right end. Left of x = 6, mode 0 leads out of it at the left; the
/// others go on: mode 1 to the left, mode 2 to the right.
Plan channel() {
  Plan plan = empty_plan(14, 5, 1.0, 1.2);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    const bool is_wall = c.iy == 0 || c.iy == 4;
    plan.heading_rad[i] = is_wall    ? std::numeric_limits<float>::quiet_NaN()
                          : c.ix < 6 ? Heading::stored(pi)
                                     : 0.0F;
    if (is_wall) plan.region[i] = Region::obstacle;
    if (!is_wall && c.ix == 13) plan.region[i] = Region::goal;
  }
  for (const float rad : {Heading::stored(pi), 0.0F}) {
    plan.mode_heading_rad.insert(plan.mode_heading_rad.end(), plan.grid.size(), rad);
    plan.record.modes.push_back({"direction", static_cast<double>(rad)});
  }
  return plan;
}

struct Proved {
  Plan plan = channel();
  PlanFlow held{plan};
  Certified proof;
  Proved() {
    CertifyOptions options;
    options.samples = 1000;
    options.last_level = 6;
    proof = certify(held.flow(), held.is_free, options, {}, {}, plan.further_rad());
  }
  ProofView view() const {
    return {held.flow(), proof.sections.view(), 2, plan.mode_heading_rad.data(),
            proof.further.view()};
  }
};

TEST(ModeTrial, LikesTheModeThatArrivesWhereNothingIsProved) {
  Proved p;
  for (auto* sections : {&p.proof.sections, &p.proof.further}) {
    std::fill(sections->verdict.begin(), sections->verdict.end(), std::uint8_t{0});
  }
  const ProofView nothing = p.view();
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    const double x = random.uniform(1.0, 3.0);
    const double y = random.uniform(2.0, 3.0);
    const double heading_rad = random.uniform(-0.5, 0.5);
    EXPECT_EQ(liked_mode(nothing, 0, x, y, heading_rad), 2);
    const ModeTrial trial = try_mode(nothing, 2, x, y, heading_rad);
    EXPECT_TRUE(trial.arrives);
    EXPECT_NEAR(trial.length_m, 13.0 - x, 1.0);
    EXPECT_FALSE(try_mode(nothing, 0, x, y, heading_rad).arrives);
    // Of modes that fare alike, the one that is flown.
    EXPECT_EQ(liked_mode(nothing, 0, x + 6.0, y, 0.0), 0);
    EXPECT_EQ(liked_mode(nothing, 2, x + 6.0, y, 0.0), 2);
    ModeChoice choice(nothing);
    const ProvedState told = choice.at(x, y, heading_rad);
    EXPECT_EQ(told.mode, 2);
    EXPECT_EQ(told.verdict, Verdict::undecided);
  }
  // Nobody turns round in the channel: all leave it at the left, the one that is flown as well.
  EXPECT_EQ(liked_mode(nothing, 1, 3.0, 2.5, pi), 1);
  EXPECT_FALSE(try_mode(nothing, 1, 3.0, 2.5, pi).arrives);
  EXPECT_FALSE(try_mode(nothing, 1, -3.0, 2.5, pi).arrives);
}

TEST(ModeTrial, ArrivesWhereAModeIsProved) {
  const Proved p;
  const ModeTrial trial = try_mode(p.view(), 2, 2.3, 2.5, 0.0);
  EXPECT_TRUE(trial.arrives);
  EXPECT_LT(trial.length_m, 1.5);  // mode 2 itself is proved from the next cell on
}

}  // namespace
}  // namespace fairway
