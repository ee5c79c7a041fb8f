// Attacks proofs of plans with modes under a contract (docs/modes.md): behaviours that keep it, and
// change modes as the vehicle may and must, told estimates as wrong as the contract lets them be,
// are flown from states that a mode is proved to bring. They must reach, and in time.
//
// Half of the flights are aimed at hand-overs: some begin as a vehicle does that was just handed
// over, up to twice the error off the leaf, where the leaf's bound is claimed of the next mode; the
// others on the way to a leaf, most of them to the end of one beside which nothing is handed over,
// or to another mode. The others begin anywhere. About one in a hundred is flown by the
// vehicle's own loop (runtime::ContractPilot).
//
// What a flight contradicts is the claim that its last stretch begins with, that of a query or that
// of the leaf that was handed over. So that stretch is proved to be within the contract
// (behaviour/proved_ends.hpp), and not to pass a leaf at which the vehicle would have changed. As
// in contract_attack.hpp, most flights end where the same is claimed, but none that is aimed before
// it has changed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fairway/certificate/contract_certificate.hpp"
#include "tests/falsify/progress.hpp"

namespace fairway {

struct ContractModeAttackOptions {
  std::uint64_t flights = 100000;  ///< at least
  std::uint64_t seed = 1;
  std::uint64_t whole_one_in = 8;
  AttackProgress progress = go_on_silently;
};

struct ContractModeAttackTotals {
  std::uint64_t states = 0;  ///< asked about
  std::uint64_t flights = 0;
  std::uint64_t aimed = 0;      ///< of the flights, at hand-overs
  std::uint64_t at_once = 0;    ///< of these, begun as handed over
  std::uint64_t through = 0;    ///< of the flights, changed on the way
  std::uint64_t changes = 0;    ///< on the way
  std::uint64_t by_loop = 0;    ///< of the flights, by a ContractPilot
  std::uint64_t handed_on = 0;  ///< of the flights, ended where the same was claimed
  std::uint64_t contradictions = 0;
  std::uint64_t late = 0;
  std::uint64_t unproved = 0;  ///< another end, by a flight that is not proved to be allowed
  std::vector<std::string> stories;

  void add(const ContractModeAttackTotals& other);
  std::uint64_t wrong() const { return contradictions + late; }
  std::string line() const;
};

/// All cores; the same for any number of threads. `certificate` has further modes.
[[nodiscard]] ContractModeAttackTotals attack_contract_modes(
    const ContractCertificate& certificate, const ContractModeAttackOptions& options);

}  // namespace fairway
