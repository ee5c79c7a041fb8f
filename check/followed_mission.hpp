// Whether what a certificate says is followed is what its plan's mission asks for.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "check/follow_claims.hpp"

namespace fairway_check {

/// `follow`: the certificate's record of it. Requires of a path that its line is the mission's, the
/// same way round and from its first vertex to its last, with bends cut by no more than 1.5 turning
/// radii; of a goal to hold at, that the disc is about it, and no wider than asked for. Throws
/// Defect 1, or nlohmann::json::exception when the plan has no such mission.
void require_mission(const FollowClaims& claims, const nlohmann::json& follow,
                     const std::string& plan_path);

}  // namespace fairway_check
