// The second proof of a run whose scenario has a contract: what its vehicle does whatever it does
// within the contract, certified, checked, and told after what is proved of the exact vehicle.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/plan/plan.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

struct ProvedUnderContract {
  ContractVerification verification;
  bool checked = false;  ///< by the separate program
};

/// Nothing when the plan has no contract, or verify.method is not "certified", or, with a warning,
/// when the contract is too wide for every cell; else the certificate is in the folder `place`.
/// Limits are the scenario's, for this proof alone. When the separate program refuses the
/// certificate, there is none, nothing is claimed, and a warning says why: what is proved of the
/// exact vehicle does not depend on it.
[[nodiscard]] std::optional<ProvedUnderContract> prove_under_contract(
    const Plan& plan, const Scenario& scenario, const RegionOfInterest& region,
    const std::filesystem::path& place, StageClock& clock, std::vector<std::string>& warnings);

/// The lines after those about the exact vehicle. Their shares of all states sum to 1.
[[nodiscard]] std::vector<Finding> findings(const Plan& plan, const ProvedUnderContract& proved);

/// Lines below the findings, each ending with a newline: who checked the proof, the longest time,
/// and the two places that most of what is unproved waits for.
[[nodiscard]] std::string notes_of(const ProvedUnderContract& proved);

/// The same in prose.
[[nodiscard]] std::string words_of(const Plan& plan, const ProvedUnderContract& proved);

/// That a limit ended the proof, or the search for behaviours that fail.
[[nodiscard]] std::optional<std::string> limit_warning(const ProvedUnderContract& proved);

/// The member `contract` of summary.json.
[[nodiscard]] nlohmann::json json_of(const ProvedUnderContract& proved);

}  // namespace fairway
