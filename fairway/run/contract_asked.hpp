// Which proof is asked for, and under which contract: what `fairway verify` and Python have in
// common.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "fairway/plan/plan.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

struct ProofRequest {
  std::string method;                             ///< "certified", "contract", ...; empty: not said
  std::optional<VehicleContract> contract;        ///< given beside the plan
  bool resumes = false;                           ///< from a certificate of whichever kind
  const EarlierContractProof* earlier = nullptr;  ///< when it is one under a contract
};

/// The contract to verify under: the one given, or the plan's own, or that of the certificate to
/// resume from, or of the exact vehicle when it is to follow a path; none when the exact vehicle's
/// verdicts are asked for. Throws InputError{where, ...} when the method is "contract" and there is
/// none.
[[nodiscard]] std::optional<VehicleContract> contract_asked(const Plan& plan,
                                                            const std::string& where,
                                                            const RegionOfInterest& region,
                                                            const ProofRequest& request);

/// verify_contract() of what was asked: of the exact vehicle (nearly_exact) without a tube nothing
/// is proved, as exact verdicts say more then (is_for_exact_verdicts). Throws InputError{where,
/// ...}, too, when the contract is too wide for every cell.
[[nodiscard]] ContractVerification verify_asked(
    const Plan& plan, const std::string& where, const RegionOfInterest& region,
    const VehicleContract& contract, ContractVerifyOptions options,
    const std::function<void(const std::string& doing)>& progress,
    const EarlierContractProof* earlier);

/// That nothing was proved: the exact vehicle's verdicts are to be.
[[nodiscard]] bool is_for_exact_verdicts(const ContractVerification& made);

}  // namespace fairway
