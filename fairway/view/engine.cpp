#include "fairway/view/engine.hpp"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/proof_identity.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/report/page_arrays.hpp"
#include "fairway/report/page_payload.hpp"
#include "fairway/report/page_verdicts.hpp"
#include "fairway/run/final_legs.hpp"
#include "fairway/run/path_segments.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/run/version.hpp"
#include "fairway/steer/dubins_words.hpp"
#include "fairway/verify/sample_verdicts.hpp"
#include "fairway/view/question.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What a page can draw in a moment; a longer flight is cut, and marked so.
constexpr std::size_t most_pieces = 20'000;

json pieces_json(const std::vector<FlightSegment>& segments) {
  json pieces = json::array();
  for (const FlightSegment& s : segments) {
    if (pieces.size() == most_pieces) break;
    pieces.push_back({s.start.position_m.x, s.start.position_m.y, s.start.heading.rad(), s.length_m,
                      s.curvature_per_m});
  }
  return pieces;
}

json finite_or_null(double value) { return std::isfinite(value) ? json(value) : json(); }

json leg_json(const FinalLeg& leg) {
  return {{"state", name_of(leg.state)},
          {"word", leg.word},
          {"length_m", leg.length_m},
          {"time_s", leg.time_s},
          {"pieces", pieces_json(leg.segments)}};
}

/// Whether tracks can begin there: the border belongs to its cells.
bool is_on(const Grid& grid, Vec2 p) {
  return p.x >= grid.x0_m && p.x < grid.x0_m + grid.width_m() && p.y >= grid.y0_m &&
         p.y < grid.y0_m + grid.height_m() && grid.contains(grid.cell_of(p));
}

/// A flight from outside the grid: it has already left.
Flight left_at_once(const State& start) {
  Flight flight;
  flight.start = start;
  flight.result = {Outcome::leave, 0.0, 0.0};
  return flight;
}

json state_json(const FlightEngine& flights, const Grid& grid,
                const runtime::Certificate* certificate, const State& start) {
  json answer = {{"verdict", nullptr}, {"time_bound_s", nullptr}, {"contract", nullptr}};
  if (certificate != nullptr) {
    const runtime::Answer found =
        certificate->query(start.position_m.x, start.position_m.y, start.heading.rad());
    answer["verdict"] = name_of(found.verdict);
    answer["time_bound_s"] = finite_or_null(found.time_bound_s);
    if (certificate->modes() > 1) answer["mode"] = found.mode;
  }
  const Flight flight =
      is_on(grid, start.position_m) ? flights.record(start, 0, one_lap) : left_at_once(start);
  answer["flight"] = {{"outcome", name_of(flight.result.outcome)},
                      {"time_s", finite_or_null(flight.result.time_s)},
                      {"length_m", finite_or_null(flight.result.length_m)},
                      {"cut", flight.segments.size() > most_pieces},
                      {"pieces", pieces_json(flight.segments)}};
  if (flight.final_leg.state != FinalLegState::not_asked) {
    answer["flight"]["leg"] = leg_json(flight.final_leg);
  }
  return answer;
}

/// A million states at most: about a second.
VerdictMapOptions quick_sampling(const Grid& grid) {
  constexpr std::size_t most_states = 1'000'000;
  VerdictMapOptions options;
  options.states_per_sample = 0;
  options.headings = 72 * grid.size() <= most_states ? 72 : 36;
  options.most_across = 166;
  if (options.headings == 72) options.most_across = std::max(grid.nx, grid.ny);
  return options;
}

const Plan& with_mission(const Plan& plan, const std::string& where) {
  if (plan.record.mission) return plan;
  throw InputError(where, "its record has no mission; expected a plan made by fairway");
}

}  // namespace

LiveEngine::LiveEngine(const fs::path& folder, const ReplanLimits& limits,
                       const fs::path& contract_certificate)
    : plan_(read_plan(folder / product::plan)),
      flights_(with_mission(plan_, (folder / product::plan).string())),
      moved_(plan_, limits) {
  read_exact(folder / product::certificate);
  const fs::path of_run = folder / product::contract_certificate;
  if (!contract_certificate.empty()) {
    contract_ = std::make_unique<LiveContract>(contract_certificate, plan_);
  } else if (fs::exists(of_run)) {
    contract_ = std::make_unique<LiveContract>(of_run, plan_);
  }
}

void LiveEngine::read_exact(const fs::path& file) {
  if (!fs::exists(file)) return;
  // Read once as a whole, which checks digests. The answers then come from the file's bytes, read
  // rather than mapped, so that changes to the file while the page is open do not matter.
  const Certificate whole = read_certificate(file);
  if (proof_identity(whole) != proof_identity(plan_, whole.region_of_interest)) {
    throw InputError(file.string(), "belongs to a different plan or vehicle than plan.safetensors");
  }
  file_ = std::make_unique<LoadedFile>(file);
  if (certificate_.open(file_->bytes().data(), file_->bytes().size()) != runtime::Status::ok) {
    throw InputError(file.string(), "is not a certificate");
  }
  flights_.decide_by(certificate_.proof());
}

json LiveEngine::info() const {
  const std::string fixed = moved_.refusal();
  return {{"live", true},
          {"program", program_version},
          {"verdicts", file_ != nullptr},
          {"contract", contract_ ? contract_->contract() : json()},
          {"replan", fixed.empty()},
          {"replan_refused", fixed.empty() ? json() : json(fixed)},
          {"plan_sha256", json::parse(json_text(plan_digests(plan_)))}};
}

json LiveEngine::state(const State& start, std::optional<Vec2> goal_m) const {
  if (!goal_m) {
    json own = state_json(flights_, plan_.grid, file_ ? &certificate_ : nullptr, start);
    if (contract_) own["contract"] = contract_->state(start);
    return own;
  }
  auto answer = moved_.plan_to(*goal_m);
  if (const auto* refused = std::get_if<MissionRefusal>(&answer)) {
    throw BadQuestion(refused->message);
  }
  const auto& live = *std::get<std::shared_ptr<const LivePlan>>(answer);
  const auto proof = live.proof();
  const runtime::Certificate certificate = proof ? proof->asked() : runtime::Certificate{};
  return state_json(live.flights, plan_.grid, proof ? &certificate : nullptr, start);
}

json LiveEngine::replan(Vec2 goal_m) const {
  const auto answer = moved_.plan_to(goal_m);
  if (const auto* refused = std::get_if<MissionRefusal>(&answer)) {
    return {{"refused", refused->message}};
  }
  const LivePlan& live = *std::get<std::shared_ptr<const LivePlan>>(answer);
  const Plan& plan = live.plan;
  PagePayload arrays;
  add_plan_arrays(plan, arrays);
  return {{"refused", nullptr},
          {"verified", live.proof() != nullptr},
          {"mission", json::parse(json_text(plan.record)).at("mission")},
          {"cost_step_m", page_cost_step_m(plan)},
          {"plan_sha256", json::parse(json_text(plan_digests(plan)))},
          {"arrays", base64(arrays.bytes())}};
}

json LiveEngine::proof(Vec2 goal_m) const {
  auto answer = moved_.plan_to(goal_m);
  if (const auto* refused = std::get_if<MissionRefusal>(&answer)) {
    throw BadQuestion(refused->message);
  }
  const LivePlan& live_plan = *std::get<std::shared_ptr<const LivePlan>>(answer);
  const auto proof = moved_.proof_of(live_plan);
  const Certificate& certificate = proof->certificate;
  const VerdictMap map = verdict_map_of(certificate.view(), quick_sampling(certificate.grid));
  PagePayload arrays;
  add_verdict_arrays(map, arrays);
  add_mode_arrays(map, live_plan.plan, arrays);
  return {{"volume_fraction", shares_json(proof->volume.all)},
          {"volume_fraction_free", shares_json(proof->volume.free)},
          {"volume_fraction_free_commanded", shares_json(proof->volume.commanded)},
          {"volume_fraction_buffer", shares_json(proof->volume.buffer)},
          {"stopped_by", name_of(proof->stopped_by)},
          {"verdicts", json::parse(page_verdicts_json(map))},
          {"arrays", base64(arrays.bytes())}};
}

json LiveEngine::steer(const State& from, const State& to) const {
  json answer = leg_json(FinalLegs(plan_, to).leg_from(from, 0.0));
  const DubinsPath shortest = shortest_path(from, to, plan_.vehicle.turn_radius_m);
  answer["shortest"] = {{"word", name_of(shortest.word)},
                        {"length_m", shortest.length_m()},
                        {"pieces", pieces_json(segments_of(shortest))}};
  return answer;
}

}  // namespace fairway
