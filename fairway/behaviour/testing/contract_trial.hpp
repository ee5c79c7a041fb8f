// A random plan with a random contract, degenerate ones among them.
#pragma once

#include <cmath>
#include <limits>

#include "fairway/base/random.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {

struct ContractTrial {
  Plan plan;
  VehicleContract contract;
};

inline ContractTrial contract_trial(std::uint64_t seed) {
  Random random = Random::stream(0xbe4a, seed);
  ContractTrial trial{random_plan(seed), {}};
  Plan& plan = trial.plan;
  if (random.below(2) == 0) {  // smoother than those of the exact prover's tests, with walls
    plan = empty_plan(16, 13, 2.0, random.uniform(2.5, 9.0));
    const double twist = random.uniform(-3.0, 3.0);
    const double weave = random.below(2) == 0 ? 0.0 : 0.9;
    const double goal_radius = plan.vehicle.turn_radius_m * random.uniform(0.8, 2.0);
    const Vec2 goal{random.uniform(8.0, 24.0), random.uniform(8.0, 18.0)};
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      const Vec2 p = plan.grid.center(plan.grid.cell_at(i));
      plan.heading_rad[i] = Heading::stored(std::atan2(goal.y - p.y, goal.x - p.x) +
                                            weave * std::sin(0.5 * p.x + twist));
      if (random.below(40) == 0) plan.region[i] = Region::obstacle;
      if (norm(p - goal) < goal_radius) plan.region[i] = Region::goal;
      if (plan.region[i] == Region::obstacle || random.below(40) == 0) {
        plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
  VehicleContract& contract = trial.contract;
  contract = VehicleContract::of(plan.vehicle);
  const double r = plan.vehicle.turn_radius_m;
  if (random.below(4) != 0) contract.command_error_m = random.uniform(0.0, 0.4) * r;
  if (random.below(4) != 0) contract.heading_error_rad = random.uniform(0.0, 0.1);
  if (random.below(3) != 0) contract.turn_radius_m = {0.85 * r, 1.15 * r};
  if (random.below(3) == 0) contract.side_uncertain_rad = random.uniform(0.0, 0.6);
  if (random.below(4) == 0) contract.hold_side_rad = random.uniform(1.0, 2.5);
  if (random.below(4) == 0) contract.look_ahead_m = random.uniform(0.0, 0.4) * r;
  return trial;
}

inline State random_state(const Flow& flow, Random& random) {
  const Grid& g = flow.grid;
  const Vec2 p{g.x0_m + g.width_m() * random.unit(), g.y0_m + g.height_m() * random.unit()};
  return {p, Heading::from_rad(random.uniform(-pi, pi))};
}

}  // namespace fairway
