#include "tests/falsify/contract_mode_proof.hpp"

#include <chrono>
#include <cmath>
#include <limits>

#include "fairway/base/random.hpp"
#include "fairway/inclusion/contract_modes.hpp"
#include "fairway/inclusion/inclusion_prover.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

InclusionLimits limits_of(const ModeProofEffort& effort) {
  InclusionLimits limits;
  limits.last_level = effort.last_level;
  const auto start = std::chrono::steady_clock::now();
  limits.go_on = [start, limit_s = effort.time_limit_s] {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    return spent.count() < limit_s;
  };
  return limits;
}

}  // namespace

ContractCertificate prove_with_modes(const Plan& plan, const VehicleContract& contract,
                                     const EstimateError& error, const ModeProofEffort& effort) {
  const PlanFlow held(plan);
  ContractCertificate proved;
  proved.grid = plan.grid;
  proved.vehicle = plan.vehicle;
  proved.contract = contract;
  proved.parts_per_cell = effort.per_cell;
  proved.heading_rad = plan.heading_rad;
  proved.region = plan.region;
  proved.kind = held.kind;
  proved.mode_heading_rad = plan.mode_heading_rad;
  const Flow flow = proved.flow();
  const VehicleContract ground = over_ground(contract);
  const Parts parts(flow, ground, effort.per_cell);
  InclusionProver prover(parts, limits_of(effort));
  prover.run([](const InclusionLevel&) {});
  proved.verdicts = prover.verdicts(ground.speed_mps.least);
  const ContractModesProof further =
      prove_contract_modes(flow, plan.further_rad(), ground, effort.per_cell, error,
                           ContractMode{parts, proved.verdicts}, limits_of(effort), [](int) {});
  proved.mode_verdicts = joined(further.further);
  return proved;
}

ContractModeTrial contract_mode_trial(std::uint64_t seed) {
  Random random = Random::stream(0xc0de5, seed);
  ContractModeTrial trial;
  Plan& plan = trial.plan;
  plan = empty_plan(18, 15, 1.0, random.uniform(1.4, 2.6));
  const Vec2 goal{random.uniform(5.0, 13.0), random.uniform(4.0, 11.0)};
  const std::uint64_t obstacles = 20 + random.below(40);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Vec2 to = goal - plan.grid.center(plan.grid.cell_at(i));
    plan.heading_rad[i] = Heading::stored(std::atan2(to.y, to.x));
    if (norm2(to) < 4.0) plan.region[i] = Region::goal;
    if (norm2(to) < 9.0 || random.below(obstacles) != 0) continue;
    plan.region[i] = Region::obstacle;
    plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
  }
  const double turned_rad = random.uniform(0.0, 0.25 * pi);
  const std::uint64_t directions = 3 + random.below(4);
  for (std::uint64_t k = 0; k < directions; ++k) {
    const double at =
        turned_rad + two_pi * static_cast<double>(k) / static_cast<double>(directions);
    plan.mode_heading_rad.insert(plan.mode_heading_rad.end(), plan.grid.size(),
                                 Heading::stored(std::remainder(at, two_pi)));
  }
  VehicleContract& contract = trial.contract;
  contract = VehicleContract::of(plan.vehicle);
  const double r = plan.vehicle.turn_radius_m;
  contract.turn_radius_m = {0.95 * r, 1.05 * r};
  contract.speed_mps.least *= 0.95;
  contract.command_error_m = random.uniform(0.06, 0.33);
  contract.heading_error_rad = random.uniform(0.01, 0.04);
  if (random.below(3) == 0) contract.side_uncertain_rad = random.uniform(0.1, 0.3);
  return trial;
}

}  // namespace fairway
