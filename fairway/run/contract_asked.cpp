#include "fairway/run/contract_asked.hpp"

#include "fairway/base/error.hpp"
#include "fairway/run/contract_warning.hpp"
#include "fairway/run/path_follower.hpp"

namespace fairway {

std::optional<VehicleContract> contract_asked(const Plan& plan, const std::string& where,
                                              const RegionOfInterest& region,
                                              const ProofRequest& request) {
  const bool is_open = request.method.empty();
  if (!is_open && request.method != "contract") return std::nullopt;
  if (request.contract) return request.contract;
  // Without a method asked for, a path is followed, by the exact vehicle if there is no contract.
  std::optional<VehicleContract> contract =
      is_open && !request.resumes ? contract_to_prove(plan, region) : plan.record.contract;
  if (!contract && request.earlier != nullptr) contract = request.earlier->certificate.contract;
  if (!contract && !is_open) {
    throw InputError(where,
                     "carries no contract: give one, in a file with [vehicle.contract], or plan "
                     "from a scenario that has it");
  }
  return contract;
}

ContractVerification verify_asked(const Plan& plan, const std::string& where,
                                  const RegionOfInterest& region, const VehicleContract& contract,
                                  ContractVerifyOptions options,
                                  const std::function<void(const std::string& doing)>& progress,
                                  const EarlierContractProof* earlier) {
  if (is_wild_everywhere(plan, contract)) {
    throw InputError(where, "nothing was proved: " + contract_warning(plan, contract).value_or(""));
  }
  options.or_touch = contract != nearly_exact(plan.vehicle);
  return verify_contract(plan, where, region, contract, options, progress, earlier);
}

bool is_for_exact_verdicts(const ContractVerification& made) {
  return made.no_tube && is_exact(made.certificate);
}

}  // namespace fairway
