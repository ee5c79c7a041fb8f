// Which sampled states of a verdict map under a contract are at risk, with witnesses for the page.
#pragma once

#include <cstddef>

#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/report/page_witnesses.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

struct AtRiskOptions {
  std::size_t most_searches = 8000;  ///< of a few milliseconds each
  std::size_t most_steps = 48'000;   ///< of all witnesses kept: some 5 bytes of the page each
  std::size_t longest_steps = 2000;  ///< of one that is kept
};

/// Searches in every undecided state of `map`, as a query does; of a path, where a way leads to it:
/// elsewhere nothing is claimed. Where that is more than the options
/// allow, in states spread evenly over them; and so are the witnesses that are kept. Depends on the
/// arguments alone.
[[nodiscard]] PageWitnesses find_at_risk(const ContractCertificate& certificate,
                                         const VerdictMap& map, const AtRiskOptions& options = {});

}  // namespace fairway
