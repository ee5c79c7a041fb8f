// Attacks proofs of plans with modes (verify/hand_over.hpp): from states that a mode is proved to
// bring, the vehicle flies that mode and changes where the certificate says so. It must reach, and
// in time.
//
// States lie where a proof would be wrong first: on and just before leaves of further modes, above
// all at their ends, where the neighbour is handed over to another mode or not proved; and where
// the answer changes, found by bisection. Most flights go by the leaves: who meets the section in a
// leaf that is handed over changes there, to the mode that the leaf names, and nowhere else. Some
// go by the proof, as a vehicle does: they ask at every border (run/proved_modes.hpp).
//
// What flights in doubles contradict is flown again in 237 bits, by the leaves, from the start and
// from every state in which the mode was changed by the proof.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fairway/plan/plan.hpp"
#include "fairway/verify/ask_modes.hpp"
#include "tests/falsify/progress.hpp"

namespace fairway {

struct ModeAttackOptions {
  std::uint64_t hand_overs = 10000;  ///< go on until so many flights have changed modes
  std::uint64_t states = 0;          ///< or so many states were asked; 0: no limit
  std::uint64_t wrong_enough = 50;   ///< or so many contradicted the proof
  std::uint64_t seed = 1;
  AttackProgress progress = go_on_silently;
};

struct ModeAttackTotals {
  std::uint64_t states = 0;      ///< asked about
  std::uint64_t flights = 0;     ///< from states that are proved to reach
  std::uint64_t hand_overs = 0;  ///< of these, changed modes on the way
  std::uint64_t by_proof = 0;    ///< of the flights, decided by the proof
  std::uint64_t changes = 0;
  std::uint64_t contradictions = 0;
  std::uint64_t late = 0;     ///< flown longer than the bound
  std::uint64_t refuted = 0;  ///< the flight in doubles was wrong; those in 237 bits agree
  std::uint64_t unknown = 0;  ///< not settled in 237 bits either
  std::vector<std::string> stories;

  void add(const ModeAttackTotals& other);
  std::uint64_t wrong() const { return contradictions + late; }
  std::string line() const;
};

/// All cores. The same for any number of threads. Throws PreconditionViolation unless `proof` has
/// further modes.
[[nodiscard]] ModeAttackTotals attack_modes(const ProofView& proof,
                                            const ModeAttackOptions& options);

}  // namespace fairway
