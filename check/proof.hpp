// THE check: a certificate's structure, then the rule (docs/trust.md) leaf by leaf, then its
// claimed shares of volume against sampled states.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace fairway_check {

/// "" when the certificate is accepted, else why it is refused; what was found goes into `report`.
/// `plan` may be "": then it is not compared. The answer does not depend on threads. Throws Defect
/// 65 or nlohmann::json::exception when the file is no certificate.
std::string judge(const std::string& path, const std::string& plan, std::size_t samples,
                  nlohmann::ordered_json& report);

}  // namespace fairway_check
