// For tests: what the checker says of a certificate.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "check/proof.hpp"

namespace fairway_check {

/// "" when it is accepted; else why not, begun with "unreadable: " when it is none.
inline std::string refusal_of(const std::filesystem::path& certificate, const std::string& plan,
                              std::size_t samples) {
  nlohmann::ordered_json report;
  try {
    return judge(certificate, plan, samples, report);
  } catch (const Defect& defect) {
    return std::string("unreadable: ") + defect.what();
  } catch (const nlohmann::json::exception& error) {
    return std::string("unreadable: ") + error.what();
  }
}

}  // namespace fairway_check
