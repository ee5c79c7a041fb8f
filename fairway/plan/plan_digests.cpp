#include "fairway/plan/plan_digests.hpp"

#include <span>

#include "fairway/base/digest.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/plan/plan_digests_json.hpp"

namespace fairway {

PlanDigests plan_digests(const Plan& plan) {
  const auto digest = [](const auto& array) { return sha256_hex(std::as_bytes(std::span(array))); };
  return {digest(plan.heading_rad), digest(plan.cost_m), digest(plan.region)};
}

std::string json_text(const PlanDigests& digests) {
  return nlohmann::json{
      {"heading_rad", digests.heading_rad}, {"cost_m", digests.cost_m}, {"region", digests.region}}
      .dump();
}

PlanDigests plan_digests_of_json(const nlohmann::json& value, const std::string& where) {
  return {text_member(value, "heading_rad", where), text_member(value, "cost_m", where),
          text_member(value, "region", where)};
}

}  // namespace fairway
