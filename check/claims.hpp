// Compares the volumes a certificate claims with sampled states. No verdict depends on this.
#pragma once

#include <string>

#include "check/certificate.hpp"

namespace fairway_check {

/// "" when no claimed share of volume is farther than five standard errors (of both samples) from
/// the one measured with `samples` states, and no more states reach later than chance allows. The
/// findings go into `report`. Throws Defect 1, or nlohmann::json::exception, for impossible
/// claims.
std::string defect_of_claims(const Certificate& c, std::size_t samples,
                             nlohmann::ordered_json& report);

}  // namespace fairway_check
