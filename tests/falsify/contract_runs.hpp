// What fairway-falsify does under a vehicle contract: proofs made and attacked, one after another,
// and told on stdout.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fairway {

struct ContractRuns {
  std::vector<std::string> plans;  ///< files, attacked if there is a contract
  std::string contract;            ///< its file
  std::uint64_t random_plans = 0;
  std::uint64_t random_plans_with_modes = 0;
  std::uint64_t flights = 100000;  ///< at least, of each plan
  std::uint64_t seed = 1;
  int parts = 2;  ///< along the side of a cell
  double time_limit_s = 60.0;
};

/// How many flights contradict a verdict under a contract.
[[nodiscard]] std::uint64_t contradicted_contracts(const ContractRuns& runs);

}  // namespace fairway
