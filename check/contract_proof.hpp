// THE check of a contract certificate: its structure, then the rule (docs/trust.md, "The second
// theorem") leaf by leaf and group by group, then its claimed shares against sampled states.
#pragma once

#include <deque>
#include <string>

#include <nlohmann/json.hpp>

#include "check/claims.hpp"
#include "check/contract_certificate.hpp"
#include "check/contract_flight.hpp"

namespace fairway_check {

/// What the leaves say about every behaviour from single states. Not by two threads at once.
class StatesTold {
 public:
  explicit StatesTold(const ContractCertificate& c);
  /// In an ordinary cell, at (x, y) in cells from its centre.
  Told operator()(std::size_t cell, double x, double y, double heading_rad);

 private:
  const ContractCertificate& c_;
  std::deque<Behaviours> behaviours_;  ///< of each mode
};

/// As `judge` (proof.hpp), but throws Defect 1 where that gives the reason.
std::string judge_contract(const std::string& path, const std::string& plan, std::size_t samples,
                           nlohmann::ordered_json& report);

}  // namespace fairway_check
