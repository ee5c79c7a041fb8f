// The rule (docs/trust.md), leaf by leaf, and the claimed shares, by sampled states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "check/certificate.hpp"

namespace fairway_check {

/// A leaf whose verdict does not follow, and why.
struct Failure {
  std::size_t section = 0;
  std::size_t leaf = 0;
  std::string reason;
};
/// Follows every decided leaf and applies the rule; in the order of the leaves.
std::vector<Failure> failures(const Certificate& certificate);

/// What the leaves say of states drawn from all ordinary cells.
struct Measured {
  std::array<double, 3> states{};  ///< by Portion
  PortionShares shares{};
  double slower_than_claimed =
      0.0;  ///< share of states that reach, with a bound above worst_time_s
};
Measured measure(const Certificate& certificate, std::size_t samples);
/// "" when no claimed share is farther than five standard errors from the measured one.
std::string defect_of_claims(const Certificate& certificate, const Measured& measured);

}  // namespace fairway_check
