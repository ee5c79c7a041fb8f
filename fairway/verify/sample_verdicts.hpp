// Certificate -> verdicts of sampled states, place by place.
//
// Properties that always hold: those of verdict_map.hpp; every verdict except undecided is proved,
// as a query of the certificate would answer; the map depends only on its arguments, not on
// threads. Cost: about a microsecond per state and core.
#pragma once

#include <cstdint>

#include "fairway/verify/ask_modes.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

struct VerdictMapOptions {
  int headings = 8;            ///< evenly spaced, the first (almost) east; at least 1
  int states_per_sample = 32;  ///< 0 to 65535
  int most_across = 256;       ///< samples along the longer side, at least 1
  std::uint64_t seed = 1;      ///< of the states' positions
  int most_crossings = usual_most_crossings;  ///< of borders by one flight, else undecided
};

/// Throws PreconditionViolation when an option is out of range.
[[nodiscard]] VerdictMap verdict_map_of(const ProofView& proof, const VerdictMapOptions& options);

}  // namespace fairway
