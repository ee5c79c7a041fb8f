// THE check: a certificate's structure, then the rule (docs/trust.md) leaf by leaf, then its
// claimed shares of volume against sampled states.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "check/certificate.hpp"
#include "check/claims.hpp"

namespace fairway_check {

/// What the leaves say about the state at (x, y), in cells from the centre of an ordinary cell: the
/// first mode in which it reaches; where there is none, what the plan's own mode does.
Told told_of_state(const Certificate& c, std::size_t cell, double x, double y, double heading_rad);

/// For certificates of either kind: "" when it is accepted, else why it is refused; the findings go
/// into `report`. `plan` may be "": then it is not compared. The result does not depend on threads.
/// Throws Defect 65 or nlohmann::json::exception when the file is not a certificate.
std::string judge(const std::string& path, const std::string& plan, std::size_t samples,
                  nlohmann::ordered_json& report);

}  // namespace fairway_check
