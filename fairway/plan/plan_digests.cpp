#include "fairway/plan/plan_digests.hpp"

#include <span>

#include "fairway/base/digest.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/plan/plan_digests_json.hpp"

namespace fairway {

PlanDigests plan_digests(const Plan& plan) {
  const auto digest = [](const auto& array) { return sha256_hex(std::as_bytes(std::span(array))); };
  return {digest(plan.heading_rad), digest(plan.cost_m), digest(plan.region),
          plan.mode_heading_rad.empty() ? "" : digest(plan.mode_heading_rad)};
}

std::string json_text(const PlanDigests& digests) {
  nlohmann::json value{
      {"heading_rad", digests.heading_rad}, {"cost_m", digests.cost_m}, {"region", digests.region}};
  if (!digests.mode_heading_rad.empty()) value["mode_heading_rad"] = digests.mode_heading_rad;
  return value.dump();
}

PlanDigests plan_digests_of_json(const nlohmann::json& value, const std::string& where) {
  return {text_member(value, "heading_rad", where), text_member(value, "cost_m", where),
          text_member(value, "region", where),
          value.contains("mode_heading_rad") ? text_member(value, "mode_heading_rad", where) : ""};
}

}  // namespace fairway
