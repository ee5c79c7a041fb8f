#include "fairway/inclusion/behaviour_flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "fairway/base/random.hpp"
#include "fairway/inclusion/testing/behaviour.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

enum class Found { as_told, not_told, unclear };

/// Follows one behaviour to the first border that it crosses aligned with the part it leaves, or to
/// its end, and looks whether the image tells of it.
Found follow(const Parts& parts, const BehaviourImage& image, Behaviour& behaviour) {
  const double m = parts.part_m();
  const auto part_of = [&](Vec2 p) {
    return PartPlace{static_cast<int>(std::floor(p.x / m)), static_cast<int>(std::floor(p.y / m))};
  };
  constexpr double fuzzy = 2e-3;  // of headings, and of places in parts
  for (int k = 0; k < 40000; ++k) {
    const Vec2 before = behaviour.place();
    const PartPlace from = part_of(before);
    switch (parts.kind(from)) {
      case PartKind::obstacle:
        return image.may_end(Verdict::collide) ? Found::as_told : Found::not_told;
      case PartKind::outside:
        return image.may_end(Verdict::leave) ? Found::as_told : Found::not_told;
      case PartKind::goal:
        return image.may_end(Verdict::reach) ? Found::as_told : Found::not_told;
      case PartKind::closed:
      case PartKind::wild:
        return Found::not_told;  // the image would have given up
      case PartKind::ordinary:
        break;
    }
    behaviour.step(0.02 * m);
    const Vec2 after = behaviour.place();
    const PartPlace to = part_of(after);
    const int dx = to.ix - from.ix;
    const int dy = to.iy - from.iy;
    if (dx == 0 && dy == 0) continue;
    if (dx != 0 && dy != 0) return Found::unclear;  // through a corner
    const PartSide side = dx > 0   ? PartSide::east
                          : dx < 0 ? PartSide::west
                          : dy > 0 ? PartSide::north
                                   : PartSide::south;
    const Vec2 at = 0.5 / m * (before + after);
    const double along = side == PartSide::east    ? at.y - from.iy
                         : side == PartSide::west  ? from.iy + 1 - at.y
                         : side == PartSide::north ? from.ix + 1 - at.x
                                                   : at.x - from.ix;
    const HeadingArc& arc = parts.arc(from);
    const HeadingArc now{behaviour.heading_rad() - fuzzy, 2.0 * fuzzy};
    if (!arc.meets(now)) continue;
    for (const Crossing& c : image.crossings) {
      const bool same = c.part.ix == from.ix && c.part.iy == from.iy && c.side == side;
      if (same && along >= c.lo - 0.02 && along <= c.hi + 0.02 &&
          c.headings.widened(fuzzy).meets({behaviour.heading_rad(), 0.0})) {
        return Found::as_told;
      }
    }
    const bool surely_aligned =
        arc.width_rad > 2.0 * fuzzy && arc.widened(-fuzzy).meets({behaviour.heading_rad(), 0.0});
    // So near a corner the steps cannot tell by which side it leaves.
    if (along < 0.03 || along > 0.97) return Found::unclear;
    if (surely_aligned) return Found::not_told;
  }
  return Found::not_told;
}

struct Trial {
  Plan plan;
  VehicleContract contract;
  int per_cell;
};

Trial trial_of(Random& random) {
  Trial trial{
      empty_plan(14, 12, 1.0, random.uniform(1.2, 5.0)), {}, 1 + static_cast<int>(random.below(3))};
  const double twist = random.uniform(-3.0, 3.0);
  const Vec2 goal{random.uniform(2.0, 12.0), random.uniform(2.0, 10.0)};
  const auto style = random.below(2) == 0 ? FieldStyle::smooth : FieldStyle::goalward;
  for (std::size_t i = 0; i < trial.plan.grid.size(); ++i) {
    const Cell c = trial.plan.grid.cell_at(i);
    const Vec2 p{0.4 * c.ix, 0.4 * c.iy};
    trial.plan.heading_rad[i] = static_cast<float>(std::remainder(
        sample_heading(style, random, style == FieldStyle::smooth ? p : trial.plan.grid.center(c),
                       goal, twist),
        2.0 * pi));
    if (random.below(25) == 0) trial.plan.region[i] = Region::obstacle;
    if (random.below(60) == 0) trial.plan.region[i] = Region::goal;
    if (trial.plan.region[i] == Region::obstacle) {
      trial.plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  trial.contract = VehicleContract::of(trial.plan.vehicle);
  trial.contract.command_error_m = random.below(4) == 0 ? 0.0 : random.uniform(0.0, 1.0);
  trial.contract.heading_error_rad = random.below(4) == 0 ? 0.0 : random.uniform(0.0, 0.1);
  const double r = trial.plan.vehicle.turn_radius_m;
  if (random.below(3) != 0) trial.contract.turn_radius_m = {0.85 * r, 1.15 * r};
  if (random.below(3) == 0) trial.contract.side_uncertain_rad = random.uniform(0.0, 0.5);
  return trial;
}

TEST(BehaviourFlight, WhateverABehaviourDoesTheImageTellsOfIt) {
  Random random(11);
  int told = 0;
  int gave_up = 0;
  for (int round = 0; round < 60; ++round) {
    const Trial trial = trial_of(random);
    const PlanFlow held(trial.plan);
    const Flow flow = held.flow();
    const Parts parts(flow, trial.contract, trial.per_cell);
    const auto commands = filled_commands(flow.grid, flow.heading_rad);
    for (int k = 0; k < 40; ++k) {
      const Vec2 p{random.uniform(0.0, 14.0), random.uniform(0.0, 12.0)};
      const double heading = random.uniform(-pi, pi);
      const double m = parts.part_m();
      const PartPlace part{static_cast<int>(p.x / m), static_cast<int>(p.y / m)};
      if (parts.kind(part) != PartKind::ordinary) continue;
      const BehaviourImage image = image_of_state(parts, (1.0 / m) * p, heading);
      gave_up += image.gave_up ? 1 : 0;
      if (image.gave_up) continue;
      for (int flight = 0; flight < 12; ++flight) {
        Behaviour behaviour(flow, commands, trial.contract, p, heading, random.bits());
        const Found found = follow(parts, image, behaviour);
        ASSERT_NE(found, Found::not_told)
            << "round " << round << ", state " << p.x << ", " << p.y << ", " << heading
            << ", ended at " << behaviour.place().x << ", " << behaviour.place().y;
        told += found == Found::as_told ? 1 : 0;
      }
    }
  }
  EXPECT_GT(told, 10000);
  RecordProperty("gave_up", gave_up);
}

TEST(BehaviourFlight, AnImageOfABorderTellsOfBehavioursThatCrossIt) {
  Random random(12);
  int told = 0;
  for (int round = 0; round < 60; ++round) {
    const Trial trial = trial_of(random);
    const PlanFlow held(trial.plan);
    const Flow flow = held.flow();
    const Parts parts(flow, trial.contract, trial.per_cell);
    const auto commands = filled_commands(flow.grid, flow.heading_rad);
    const double m = parts.part_m();
    for (int k = 0; k < 40; ++k) {
      const PartPlace part = parts.place(random.below(parts.size()));
      if (parts.kind(part) != PartKind::ordinary) continue;
      const HeadingArc& arc = parts.arc(part);
      const auto side = static_cast<PartSide>(random.below(4));
      const double outward = 0.5 * pi * static_cast<int>(side);
      const double lo = 0.25 * static_cast<double>(random.below(4));
      const BehaviourImage image = image_of_crossing(parts, part, side, lo, lo + 0.25);
      if (image.gave_up) continue;
      for (int flight = 0; flight < 12; ++flight) {
        const double heading = random.uniform(arc.lo_rad, arc.hi_rad());
        if (std::cos(heading - outward) <= 0.02) continue;
        const double along = random.uniform(lo, lo + 0.25) - 0.5;
        const Vec2 out{std::cos(outward), std::sin(outward)};
        const Vec2 left{-out.y, out.x};
        const Vec2 middle{part.ix + 0.5, part.iy + 0.5};
        const Vec2 start = m * (middle + 0.5001 * out + along * left);
        Behaviour behaviour(flow, commands, trial.contract, start, heading, random.bits());
        const Found found = follow(parts, image, behaviour);
        ASSERT_NE(found, Found::not_told)
            << "round " << round << ", part " << part.ix << ", " << part.iy << ", side "
            << static_cast<int>(side) << ", ended at " << behaviour.place().x << ", "
            << behaviour.place().y;
        told += found == Found::as_told ? 1 : 0;
      }
    }
  }
  EXPECT_GT(told, 3000);
}

TEST(BehaviourFlight, NobodyIsLostWithinTheSlackOfABorder) {
  // Almost along a border, with commands that turn slowly from row to row and column to column: for
  // many steps a set lies within the slack of both parts, and counts as in either.
  Random random(13);
  int flown = 0;
  for (int round = 0; round < 400; ++round) {
    Plan plan = empty_plan(12, 12, 1.0, random.uniform(1.2, 4.0));
    const double by_row = random.uniform(0.0, 0.06);
    const double by_column = random.uniform(0.0, 0.004);
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      const Cell c = plan.grid.cell_at(i);
      plan.heading_rad[i] = static_cast<float>(by_row * (5.5 - c.iy) + by_column * c.ix);
    }
    VehicleContract contract = VehicleContract::of(plan.vehicle);
    contract.command_error_m = random.uniform(0.0, 0.8);
    contract.heading_error_rad = random.uniform(0.0, 0.04);
    const double r = plan.vehicle.turn_radius_m;
    contract.turn_radius_m = {0.9 * r, 1.1 * r};
    const PlanFlow held(plan);
    const Parts parts(held.flow(), contract, 1);
    for (int k = 0; k < 40; ++k) {
      const auto tiny = [&](double least_power, double most_power) {
        const double size = std::pow(10.0, -random.uniform(least_power, most_power));
        return random.below(2) == 0 ? size : -size;
      };
      const Vec2 place{random.uniform(4.0, 8.0),
                       static_cast<double>(4 + random.below(4)) + tiny(4.0, 9.0)};
      const BehaviourImage image = image_of_state(parts, place, tiny(1.0, 6.0));
      EXPECT_TRUE(image.gave_up || image.ends != 0 || !image.crossings.empty())
          << "round " << round << ", " << place.x << ", " << place.y;
      ++flown;
    }
  }
  EXPECT_GT(flown, 10000);
}

TEST(BehaviourFlight, AnArrivalTouchesNoObstacleBefore) {
  // Eastwards along a wall, at a distance of half a part: no end is told, though the wall is near.
  Plan plan = empty_plan(8, 3, 1.0, 2.0);
  for (int ix = 0; ix < 8; ++ix) plan.region[plan.grid.index({ix, 0})] = Region::obstacle;
  const PlanFlow held(plan);
  const Parts parts(held.flow(), VehicleContract::of(plan.vehicle), 1);
  const BehaviourImage clear = image_of_crossing(parts, {2, 1}, PartSide::east, 0.5, 0.75);
  EXPECT_FALSE(clear.gave_up);
  EXPECT_EQ(clear.ends, 0);
  ASSERT_EQ(clear.crossings.size(), 1U);
  EXPECT_EQ(clear.crossings[0].part.ix, 3);
  // From the wall on: it touches.
  EXPECT_TRUE(
      image_of_crossing(parts, {2, 1}, PartSide::east, 0.0, 0.25).may_end(Verdict::collide));
}

}  // namespace
}  // namespace fairway
