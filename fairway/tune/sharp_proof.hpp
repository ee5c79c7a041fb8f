// The proof of a scenario's plan, as sharp as the scenario asks for.
#pragma once

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include "fairway/plan/plan.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/verification.hpp"

namespace fairway {

/// Of a goal mission the exact vehicle's; under a contract, and where a path is to be followed, the
/// proof of that.
struct SharpProof {
  std::optional<Verification> exact;
  std::optional<ContractVerification> under_contract;

  /// Of all states, proved to do what the mission asks for: of a path that is to be followed, not
  /// only to touch it.
  [[nodiscard]] double share() const;
  [[nodiscard]] double safe_share() const;  ///< the same of safe starts
  [[nodiscard]] nlohmann::json json() const;
  /// Writes the certificate, and has the separate program check it: false when that is not there.
  [[nodiscard]] bool write_and_check(const std::filesystem::path& folder) const;
};

[[nodiscard]] SharpProof prove_sharply(const Plan& plan, const Scenario& scenario);

}  // namespace fairway
