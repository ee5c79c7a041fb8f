// The methods of `fairway verify`: each proves, or draws, writes its product and what else it was
// asked for, and returns what to tell.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/app/session.hpp"
#include "fairway/app/verify_arguments.hpp"
#include "fairway/base/atomic_file.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/ceiling_summary.hpp"
#include "fairway/run/contract_resume.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

struct VerifyTask {
  const VerifyArguments& arguments;
  const Session& session;
  const Plan& plan;
  const RegionOfInterest& region;
  StageClock& clock;
  AtomicFolder* pictures;  ///< null: none are asked for; committed once they are drawn
};

struct VerifyOutcome {
  nlohmann::json summary;
  std::vector<Finding> findings;
  std::vector<std::string> warnings;
  std::string notes;  ///< whole lines
};

/// For the exact vehicle: a certificate.
[[nodiscard]] VerifyOutcome verify_exactly(const VerifyTask& task);

/// Paper 2's method: a bitmap.
[[nodiscard]] VerifyOutcome verify_by_bitmap(const VerifyTask& task);

/// What any control could keep, if that is asked for. `kind`: of the cells, that says which are to
/// be reached; `proved`: what the plan keeps.
void add_ceiling(const VerifyTask& task, const std::vector<CellKind>& kind,
                 const ProvedShare& proved, VerifyOutcome& outcome);

/// What is asked under a contract.
struct ContractAsked {
  VehicleContract contract;
  std::optional<EarlierContractProof> earlier;
};

/// The contract to verify under: the one given, or the plan's own, or that of the certificate to
/// resume from, or of the exact vehicle when it is to follow a path; none when the exact vehicle or
/// a bitmap is asked for. Throws InputError when a contract is asked for and there is none, or
/// --resume names a certificate of the other kind.
[[nodiscard]] std::optional<ContractAsked> contract_asked(const VerifyTask& task);

/// For every vehicle that keeps the contract: a contract certificate.
[[nodiscard]] VerifyOutcome verify_under_contract(const VerifyTask& task,
                                                  const ContractAsked& asked);

}  // namespace fairway
