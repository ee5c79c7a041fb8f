// The rule (docs/trust.md), leaf by leaf, and the claimed shares, by sampled states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "check/certificate.hpp"

namespace fairway_check {

/// The directions of all commands of ordinary cells, into `certificate.loop`.
void take_directions(Certificate& certificate, int threads);

/// A leaf whose verdict does not follow, and why.
struct Failure {
  std::size_t section = 0;
  std::size_t leaf = 0;
  std::string reason;
};
/// Follows every decided leaf and applies the rule: "" when it holds, else why not.
std::string defect_of(const Certificate& certificate, std::size_t section, std::size_t leaf);
/// Of all leaves, in order; the answer does not depend on `threads`.
std::vector<Failure> failures(const Certificate& certificate, int threads);

/// Verdicts of states drawn from the volume of all ordinary cells, for what the leaves say.
struct Measured {
  std::size_t states = 0;
  std::size_t free_states = 0;  ///< of these, in safe-start cells
  Shares all{};
  Shares free{};
  Shares buffer{};
  std::size_t slower_than_claimed = 0;  ///< reach, with a bound above worst_time_s
};
Measured measure(const Certificate& certificate, std::size_t samples, std::uint64_t seed,
                 int threads);
/// "" when no claimed share is farther than five standard errors from the measured one.
std::string defect_of_claims(const Certificate& certificate, const Measured& measured);

}  // namespace fairway_check
