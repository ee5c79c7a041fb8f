#include "tests/falsify/contract_runs.hpp"

#include <cstdio>

#include <fmt/core.h>

#include "fairway/behaviour/testing/contract_trial.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/contract_file.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "tests/falsify/contract_attack.hpp"
#include "tests/falsify/contract_mode_attack.hpp"
#include "tests/falsify/contract_mode_proof.hpp"
#include "tests/falsify/contract_proof.hpp"
#include "tests/falsify/progress.hpp"

namespace fairway {
namespace {

/// Proves a plan under a contract, and attacks the proof.
ContractAttackTotals attack_contract(const std::string& name, const Plan& plan,
                                     const VehicleContract& contract, int parts, int last_level,
                                     bool quick, const ContractRuns& runs) {
  const PlanFlow plan_flow(plan);
  const Flow flow = plan_flow.flow();
  const ContractProof proof(flow, contract, parts, last_level, runs.time_limit_s);
  fmt::print("{}: {} x {} cells, {} parts a side, {} leaves, undecided {:.4f}, answered by {}\n",
             name, flow.grid.nx, flow.grid.ny, parts, proof.leaves(), proof.undecided_share(),
             quick ? "quick look-ups" : "flights of states");
  ContractAttackOptions options;
  options.flights = runs.flights;
  options.seed = runs.seed;
  options.claimed_there = [&](const State& state) { return proof.quick_claim(state); };
  options.progress = ProgressLines(name);
  const auto claim = [&](const State& state) {
    return quick ? proof.quick_claim(state) : proof.claim(state);
  };
  const ContractAttackTotals totals = attack(name, flow, contract, claim, options);
  for (const std::string& story : totals.stories) fmt::print("  {}\n", story);
  fmt::print("  {}\n", totals.line());
  std::fflush(stdout);
  return totals;
}

/// Proves a plan with its modes under a contract, and attacks the proof.
ContractModeAttackTotals attack_modes_under(const std::string& name, const Plan& plan,
                                            const VehicleContract& contract,
                                            const ModeProofEffort& effort,
                                            const ContractRuns& runs) {
  const ContractCertificate proved =
      prove_with_modes(plan, contract, EstimateError::of(contract), effort);
  fmt::print("{}: {} x {} cells, {} parts a side, {} modes, {} leaves\n", name, plan.grid.nx,
             plan.grid.ny, effort.per_cell, proved.further_modes() + 1,
             proved.verdicts.leaves() + proved.mode_verdicts.leaves());
  ContractModeAttackOptions options;
  options.flights = runs.flights;
  options.seed = runs.seed;
  options.progress = ProgressLines(name);
  const ContractModeAttackTotals totals = attack_contract_modes(proved, options);
  for (const std::string& story : totals.stories) fmt::print("  {}\n", story);
  fmt::print("  {}\n", totals.line());
  std::fflush(stdout);
  return totals;
}

std::uint64_t contradicted_modes_under(const ContractRuns& runs) {
  ContractModeAttackTotals totals;
  for (const std::string& path : runs.plans) {
    if (runs.contract.empty() || is_interrupted()) break;
    const Plan plan = read_plan(path);
    if (plan.further_modes() == 0) continue;
    totals.add(attack_modes_under(path, plan, read_contract(runs.contract, plan.vehicle),
                                  {runs.parts, 4, runs.time_limit_s}, runs));
  }
  for (std::uint64_t k = 0; k < runs.random_plans_with_modes && !is_interrupted(); ++k) {
    const std::uint64_t number = 1000003 * runs.seed + k;
    const ContractModeTrial trial = contract_mode_trial(number);
    totals.add(attack_modes_under(fmt::format("trial {} with modes", number), trial.plan,
                                  trial.contract, {1 + static_cast<int>(k % 2), 3, 60.0}, runs));
  }
  if (totals.flights > 0) fmt::print("through modes under contracts, in all: {}\n", totals.line());
  return totals.wrong();
}

}  // namespace

std::uint64_t contradicted_contracts(const ContractRuns& runs) {
  ContractAttackTotals totals;
  if (!runs.contract.empty()) {
    for (const std::string& path : runs.plans) {
      const Plan plan = read_plan(path);
      if (plan.further_modes() > 0 || is_interrupted()) continue;
      totals.add(attack_contract(path, plan, read_contract(runs.contract, plan.vehicle), runs.parts,
                                 6, runs.seed % 2 == 0, runs));
    }
  }
  for (std::uint64_t k = 0; k < runs.random_plans && !is_interrupted(); ++k) {
    const std::uint64_t number = 1000003 * runs.seed + k;
    const ContractTrial trial = contract_trial(number);
    totals.add(attack_contract(fmt::format("contract trial {}", number), trial.plan, trial.contract,
                               1 + static_cast<int>(k % 3), 2 + static_cast<int>(k % 5), k % 2 == 1,
                               runs));
  }
  if (totals.states > 0) fmt::print("under contracts, in all: {}\n", totals.line());
  return totals.wrong() + contradicted_modes_under(runs);
}

}  // namespace fairway
