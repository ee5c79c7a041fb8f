// Attacks proofs that a path is followed (inclusion/follow_proof.hpp) with behaviours that keep the
// contract: from states that are proved to follow, each flies three laps after the bound of its
// time to join. It may touch nothing, may leave the tube no more after that bound, and has to go
// round in time, or to come to the end of an open path.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fairway/certificate/contract_certificate.hpp"
#include "tests/falsify/progress.hpp"

namespace fairway {

struct FollowAttackTotals {
  std::uint64_t states = 0;   ///< asked about
  std::uint64_t flights = 0;  ///< from states that are proved to follow
  std::uint64_t laps = 0;
  std::uint64_t ended = 0;    ///< touched something
  std::uint64_t strayed = 0;  ///< out of the tube after the bound
  std::uint64_t late = 0;     ///< joined the tube too late, or went round too slowly or too fast
  double longest_lap_s = 0.0;
  double shortest_lap_s = 0.0;  ///< at the bounds' speeds; 0: none
  std::vector<std::string> stories;

  std::uint64_t wrong() const { return ended + strayed + late; }
  std::string line() const;
};

/// All cores. Throws PreconditionViolation when the certificate does not say that a path is
/// followed.
[[nodiscard]] FollowAttackTotals attack_following(const ContractCertificate& certificate,
                                                  std::uint64_t flights, std::uint64_t seed,
                                                  const AttackProgress& progress = go_on_silently);

}  // namespace fairway
