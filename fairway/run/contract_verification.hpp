// plan and contract -> verdicts under the contract -> certificate: what `fairway verify --contract`
// and `fairway run` have in common.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/inclusion/contract_shares.hpp"
#include "fairway/inclusion/inclusion_prover.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/contract_resume.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/path_follower.hpp"
#include "fairway/run/verify_limits.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

struct ContractVerifyOptions {
  int parts_per_cell = 0;  ///< 0: as fine as the command error asks for
  VerifyLimits limits;     ///< undecided_max is not used
  std::size_t samples = SurveyOptions{}.samples;
  std::uint64_t seed = 1;
  bool or_touch = true;        ///< when nobody is proved to follow a path: who touches it
  bool find_witnesses = true;  ///< of sampled states, to tell how many are at risk
};

struct ContractVerification {
  ContractCertificate certificate;
  ContractSurvey survey;
  std::vector<InclusionLevel> levels;
  bool stopped_by_limit = false;
  bool searched = false;  ///< for behaviours that fail; else nothing is known to be at risk
  /// Of the sampled states that are undecided, and how many of them were searched from.
  std::size_t undecided_states = 0;
  std::size_t searched_states = 0;
  std::optional<Resumed> resumed;  ///< when it went on from an earlier one
  /// That the path is followed, as the certificate then says.
  std::optional<Following> following;
  bool no_tube = false;  ///< following was asked for, and not proved of anybody
};

/// Proves what all behaviours within `contract` do under `plan`. Of a path mission: whether they
/// join the path and follow it; when no tube is found, only whether they touch it. `earlier`: a
/// contract certificate of the same proof, to go on cutting where it ended; all of it is proved
/// again. Throws InputError{earlier->where, ...} when it is of another one, and InputError{where,
/// ...} when the plan cannot be verified or the contract is none of its vehicle.
///
/// A limit of time holds for the proof, of which it gets at most four fifths when witnesses are
/// searched for, and for that search, which gets the rest. Measuring shares comes in addition: its
/// work does not depend on how hard the proof is.
[[nodiscard]] ContractVerification verify_contract(
    const Plan& plan, const std::string& where, const RegionOfInterest& region,
    const VehicleContract& contract, const ContractVerifyOptions& options,
    const std::function<void(const std::string& doing)>& progress,
    const EarlierContractProof* earlier = nullptr);

/// Parts along the side of a cell: the finer, the less the commands of neighbours are mixed, down
/// to the command error, which mixes them anyway.
[[nodiscard]] int usual_parts_per_cell(const VehicleContract& contract, double cell_m);

/// summary.json of verify, under a contract (docs/formats.md).
[[nodiscard]] nlohmann::json contract_verification_json(const ContractCertificate& certificate);

/// The first line says how many of all states reach, whatever the vehicle does within the contract.
[[nodiscard]] std::vector<Finding> findings(const Plan& plan, const ContractVerification& made);

/// That nobody is proved to follow the path.
[[nodiscard]] Finding no_tube_finding();

/// That a limit ended the proof, or the search for behaviours that fail.
[[nodiscard]] std::optional<std::string> limit_warning(const ContractVerification& made);

/// What was assumed, and the places that what is unproved waits for.
[[nodiscard]] std::string contract_notes(const ContractVerification& made);

/// "behaviours may touch an obstacle, or reach"
[[nodiscard]] const char* reason_of(Trouble why);

}  // namespace fairway
