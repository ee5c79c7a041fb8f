// The bounds of time of groups of leaves (docs/trust.md, "The second theorem").
#pragma once

#include <string>
#include <vector>

#include "check/contract_certificate.hpp"
#include "check/follow_proof.hpp"

namespace fairway_check {

/// Above all rounding in sums of a few hundred times.
inline constexpr double time_margin = 1.0 + 1e-9;

/// "" when no group takes longer than is claimed. `shares`: of each leaf.
std::string defect_of_groups(const ContractCertificate& c, const std::vector<Share>& shares);

}  // namespace fairway_check
