// THE check of a contract certificate: its structure, then the rule (docs/trust.md, "The second
// theorem") leaf by leaf and group by group, then its claimed shares against sampled states.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "check/claims.hpp"
#include "check/contract_certificate.hpp"

namespace fairway_check {

/// What the leaves say about every behaviour from a state in an ordinary cell, at (x, y) in cells
/// from its centre.
Told told_of_state(const ContractCertificate& c, std::size_t cell, double x, double y,
                   double heading_rad);

/// As `judge` (proof.hpp), but throws Defect 1 where that gives the reason.
std::string judge_contract(const std::string& path, const std::string& plan, std::size_t samples,
                           nlohmann::ordered_json& report);

}  // namespace fairway_check
