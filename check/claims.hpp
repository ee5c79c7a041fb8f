// What a certificate claims of volumes, against sampled states. No verdict rests on this.
#pragma once

#include <string>

#include "check/certificate.hpp"

namespace fairway_check {

/// "" when no share of volume that is claimed is farther than five standard errors (of both
/// samples) from the one measured with `samples` states, and no more reach later than chance
/// allows. What was found goes into `report`. Throws Defect 1, or nlohmann::json::exception, for
/// claims that cannot be.
std::string defect_of_claims(const Certificate& c, std::size_t samples,
                             nlohmann::ordered_json& report);

}  // namespace fairway_check
