// A ceiling in numbers and in words, and what share of it a plan keeps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/ceiling/ceiling.hpp"
#include "fairway/ceiling/find_ceiling.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/run/verify_limits.hpp"

namespace fairway {

/// Beside a proof: its limits, and two levels, as a third takes several times as long and lowers
/// the upper bound by little (docs/ceiling.md).
[[nodiscard]] CeilingOptions ceiling_options(const VerifyLimits& limits);

/// `ceiling`, `ceiling_free`, `ceiling_buffer` as [lower, upper], and how they were found.
[[nodiscard]] nlohmann::json json_of(const Ceiling& ceiling);
[[nodiscard]] std::string words_of(const Ceiling& ceiling);

/// Of what any control could keep, the share that a plan of which `proved` of all states are proved
/// keeps at least: against the upper bound.
[[nodiscard]] double share_of_ceiling(const Ceiling& ceiling, double proved);

/// What is proved of a plan, to be seen against the ceiling.
struct ProvedShare {
  double of_all = 0.0;  ///< of all states of cells that are neither obstacle nor mission
  int decimals = 1;     ///< that were measured, of a percentage
  std::string what;     ///< "are proved to reach the goal"
};

[[nodiscard]] ProvedShare proved_share(const Plan& plan, const Verification& made);

/// None when it is proved that a path is followed, or a goal held: then the proof is about the
/// cells outside its tube, and the ceiling about entering the mission's.
[[nodiscard]] std::optional<ProvedShare> proved_share(const Plan& plan,
                                                      const ContractVerification& made);

inline constexpr const char* ceiling_stage = "finding what any control could keep";
inline constexpr const char* no_ceiling_of_following =
    "What any control could keep was not compared: it is known of reaching, not of following a "
    "path or staying at a goal. (With --method certified, reaching is proved.)";

/// To a summary `ceiling`, `ceiling_free`, `ceiling_buffer`, `ceiling_levels`, `share_of_ceiling`
/// (docs/formats.md), and to `found`, unless nothing is known, "96.6 %" "what any control could
/// keep" "is kept at least: ...".
void add_ceiling(nlohmann::json& summary, std::vector<Finding>& found, const Ceiling& ceiling,
                 const ProvedShare& proved);

/// The ceiling and what is kept of it, in prose.
[[nodiscard]] std::string words_of(const Ceiling& ceiling, const ProvedShare& proved);

/// That a limit of time or memory ended the work.
[[nodiscard]] std::optional<std::string> limit_warning(const Ceiling& ceiling);

}  // namespace fairway
