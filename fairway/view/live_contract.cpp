#include "fairway/view/live_contract.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/run/products.hpp"
#include "fairway/vehicle/contract_json.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// "command_error_m is 4.0, the plan's is 6.0".
std::string difference(const VehicleContract& proved, const VehicleContract& kept) {
  const json proofs = json_of(proved);
  const json plans = json_of(kept);
  std::string words;
  for (const auto& [key, value] : proofs.items()) {
    if (plans.at(key) == value) continue;
    words += fmt::format("{}{} is {}, the plan's is {}", words.empty() ? "" : "; ", key,
                         value.dump(), plans.at(key).dump());
  }
  return words;
}

ContractCertificate certificate_for(const Plan& plan, const fs::path& file) {
  ContractCertificate found = read_contract_certificate(file);
  if (found.plan != plan_digests(plan) || found.vehicle != plan.vehicle) {
    throw InputError(file.string(),
                     fmt::format("belongs to a different plan or vehicle than {0}; expected one "
                                 "that `fairway verify {0} --contract FILE.toml` made",
                                 product::plan));
  }
  const std::optional<VehicleContract>& kept = plan.record.contract;
  if (kept && *kept != found.contract) {
    throw InputError(
        file.string(),
        fmt::format("was proved under another contract than that of {}, which this page is about: "
                    "{}; `fairway query` answers from it",
                    product::plan, difference(found.contract, *kept)));
  }
  return found;
}

json steps_json(const ExplainedBehaviour& behaviour) {
  json steps = json::array();
  for (const ExplainedStep& s : behaviour.steps) {
    steps.push_back({s.start.position_m.x, s.start.position_m.y, s.start.heading.rad(), s.length_m,
                     s.turn == 0 ? 0.0 : s.turn / s.radius_m, s.command_rad, s.command_m.x,
                     s.command_m.y});
  }
  return steps;
}

}  // namespace

LiveContract::LiveContract(const fs::path& file, const Plan& plan)
    : certificate_(certificate_for(plan, file)),
      queries_(certificate_),
      prepared_(std::async(std::launch::async, [this] { queries_.prepare_searches(); })) {}

json LiveContract::contract() const { return json_of(certificate_.contract); }

json LiveContract::state(const State& start) const {
  ContractReply reply = queries_.proved(start);
  const bool is_bounded = reply.verdict == Verdict::reach && std::isfinite(reply.time_bound_s);
  if (reply.verdict == Verdict::undecided) reply.witness = queries_.search().find(start);
  json answer = {{"verdict", reply.word()},
                 {"time_bound_s", is_bounded ? json(reply.time_bound_s) : json()},
                 {"witness", nullptr}};
  if (certificate_.further_modes() > 0) answer["mode"] = reply.mode;
  if (reply.witness) {
    const ExplainedBehaviour behaviour = queries_.explained(*reply.witness);
    const Cell end = certificate_.grid.cell_of(behaviour.end.position_m);
    answer["witness"] = {{"end", certificate_.grid.contains(end) ? "collide" : "leave"},
                         {"time_s", behaviour.time_s},
                         {"length_m", behaviour.time_s * certificate_.vehicle.speed_mps},
                         {"steps", steps_json(behaviour)}};
  }
  return answer;
}

}  // namespace fairway
