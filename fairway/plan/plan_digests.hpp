// Which plan something belongs to: the SHA-256 of its arrays, as stored in plan files and
// certificates.
#pragma once

#include <string>

#include "fairway/plan/plan.hpp"

namespace fairway {

/// In lower-case hex.
struct PlanDigests {
  std::string heading_rad;
  std::string cost_m;
  std::string region;
  std::string mode_heading_rad = {};  ///< empty: the plan has one mode
  friend bool operator==(const PlanDigests&, const PlanDigests&) = default;
};

/// {"cost_m":"...","heading_rad":"...","region":"..."}, and "mode_heading_rad" if there are modes.
[[nodiscard]] std::string json_text(const PlanDigests& digests);

[[nodiscard]] PlanDigests plan_digests(const Plan& plan);

}  // namespace fairway
