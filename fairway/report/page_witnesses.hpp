// What a page knows of states at risk under a contract: for which sampled states of a verdict map a
// behaviour within the contract is known that fails, and some of these behaviours, to be played.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/behaviour/explained_behaviour.hpp"
#include "fairway/report/page_payload.hpp"
#include "fairway/verify/verdict.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

/// A behaviour that fails from a sampled state.
struct PageWitness {
  std::size_t heading = 0;  ///< of the map, as `sample`
  std::size_t sample = 0;
  Verdict end = Verdict::collide;  ///< or leave
  ExplainedBehaviour behaviour;
};

struct PageWitnesses {
  std::vector<std::uint8_t> at_risk;  ///< [headings][ny][nx]: 1 where one is known
  std::vector<PageWitness> shown;     ///< from some of these states
  std::size_t not_searched = 0;       ///< undecided states where none was searched for
};

/// `contract_at_risk_count` [ny][nx]: for how many headings a sample is at risk. `witness_sample`,
/// `witness_heading`, `witness_end` [witnesses]; `witness_begin` [witnesses + 1]: their steps in
/// `witness_length_m`, `witness_curvature_per_m`, `witness_command` (65535ths of a turn) and
/// `witness_cell` (whose command that is, [iy][ix]) [steps].
void add_witness_arrays(const VerdictMap& map, const PageWitnesses& witnesses,
                        PagePayload& payload);

}  // namespace fairway
