#include "tests/falsify/contract_proof.hpp"

#include <chrono>

#include "fairway/inclusion/contract_lookup.hpp"
#include "fairway/inclusion/inclusion_prover.hpp"

namespace fairway {

ContractProof::ContractProof(const Flow& flow, const VehicleContract& contract, int per_cell,
                             int last_level, double time_limit_s)
    : grid_(flow.grid), over_ground_(over_ground(contract)), parts_(flow, over_ground_, per_cell) {
  InclusionLimits limits;
  limits.last_level = last_level;
  const auto start = std::chrono::steady_clock::now();
  limits.go_on = [start, time_limit_s] {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    return spent.count() < time_limit_s;
  };
  InclusionProver prover(parts_, limits);
  prover.run([this](const InclusionLevel& level) { undecided_share_ = level.undecided_share; });
  verdicts_ = prover.verdicts(over_ground_.speed_mps.least);
  lookup_.emplace(parts_, verdicts_, over_ground_.speed_mps.least);
}

ContractClaim ContractProof::claim(const State& state) const {
  const Vec2 from{grid_.x0_m, grid_.y0_m};
  const Vec2 place = (1.0 / parts_.part_m()) * (state.position_m - from);
  const auto answer =
      contract_answer(parts_, verdicts_, over_ground_.speed_mps.least, place, state.heading.rad());
  return {answer.verdict, answer.worst_time_s};
}

ContractClaim ContractProof::quick_claim(const State& state) const {
  const auto answer = lookup_->answer(grid_, state.position_m, state.heading.rad());
  return {answer.verdict, answer.worst_time_s};
}

}  // namespace fairway
