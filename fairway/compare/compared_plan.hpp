// One of the plans that are compared, with what is proved of it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fairway/certificate/certificate.hpp"
#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway {

struct ComparedPlan {
  std::string name;            ///< short, different for each
  std::filesystem::path from;  ///< as it was asked for
  Plan plan;
  std::optional<Certificate> certificate;       ///< none: its states are flown instead
  std::optional<ContractCertificate> contract;  ///< of the plan's contract, or of following
  std::vector<std::string> proofs;              ///< where they come from, one sentence each
  std::vector<std::string> warnings;            ///< one sentence each
};

}  // namespace fairway
