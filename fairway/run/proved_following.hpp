// Closed path, plan and contract -> whether the vehicle is proved to join the path and to follow it
// for ever: what `fairway verify` under a contract adds for such missions.
//
// No certificate holds this proof yet: nothing but this program has checked it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/inclusion/contract_shares.hpp"
#include "fairway/inclusion/follow_prover.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/findings.hpp"

namespace fairway {

struct ProvedFollowing {
  std::optional<Following> found;  ///< none: no tube can be proved
  ContractShares shares;           ///< of them, reach says: joins the path and follows it for ever
  double length_m = 0.0;           ///< of the path
  bool stopped_by_limit = false;
};

/// None unless the plan's mission is a closed path. `contract`: over ground (over_ground).
[[nodiscard]] std::optional<ProvedFollowing> prove_following(
    const Plan& plan, const VehicleContract& contract, int parts_per_cell,
    const SurveyOptions& sampled, const std::function<bool()>& go_on,
    const std::function<void(const std::string& doing)>& progress);

/// The object "follow" of summary.json (docs/formats.md).
[[nodiscard]] nlohmann::json following_json(const ProvedFollowing& following);

/// How many follow, how near, and how fast round.
[[nodiscard]] std::vector<Finding> findings(const ProvedFollowing& following);

}  // namespace fairway
