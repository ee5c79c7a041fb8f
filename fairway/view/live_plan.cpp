#include "fairway/view/live_plan.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/run/replan.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/view/question.hpp"

namespace fairway {
namespace {

/// The folder's mission with another goal; none for a path.
std::optional<GoalMission> moved(const Plan& plan, Vec2 goal_m) {
  const auto* goal =
      plan.record.mission ? std::get_if<GoalMission>(&*plan.record.mission) : nullptr;
  if (goal == nullptr) return std::nullopt;
  return GoalMission{goal_m, goal->goal_heading_rad};
}

}  // namespace

std::string MovedGoals::refusal() const {
  if (!moved(plan_, {})) return "only goals can be moved, but this plan follows a path";
  if (plan_.grid.size() > limits_.most_cells) {
    return fmt::format("this plan has {} cells; goals can be moved on plans of up to {}",
                       plan_.grid.size(), limits_.most_cells);
  }
  if (!(plan_.grid.cell_m < plan_.vehicle.turn_radius_m)) {
    return "this plan's cells are not smaller than the turning radius";
  }
  try {
    static_cast<void>(field_options_of(plan_.record, "plan.safetensors"));
  } catch (const InputError& wrong) {
    return wrong.what();
  }
  return {};
}

MovedGoals::Turn MovedGoals::turn() const {
  Turn made(making_, limits_.patience);
  if (!made) throw NotNow("another plan or proof is being made; try again");
  return made;
}

std::shared_ptr<const LivePlan> MovedGoals::remembered(const Mission& mission) const {
  const std::scoped_lock lock(mutex_);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const auto& one) {
    return one->plan.record.mission == mission;
  });
  return found == kept_.end() ? nullptr : *found;
}

std::variant<std::shared_ptr<const LivePlan>, MissionRefusal> MovedGoals::plan_to(
    Vec2 goal_m) const {
  if (const std::string why = refusal(); !why.empty()) throw BadQuestion(why);
  const Mission mission = *moved(plan_, goal_m);
  if (auto known = remembered(mission)) return known;
  const Turn alone = turn();
  if (auto known = remembered(mission)) return known;
  auto answer = replan(plan_, mission, field_options_of(plan_.record, "plan.safetensors"));
  if (auto* refused = std::get_if<MissionRefusal>(&answer)) return std::move(*refused);
  auto made = std::make_shared<const LivePlan>(std::move(std::get<Plan>(answer)));
  const std::scoped_lock lock(mutex_);
  kept_.push_front(made);
  if (kept_.size() > limits_.kept) kept_.pop_back();
  return made;
}

std::shared_ptr<const ShortProof> MovedGoals::proof_of(const LivePlan& live) const {
  if (auto known = live.proof()) return known;
  const Turn alone = turn();
  if (auto known = live.proof()) return known;
  CertifyOptions options;
  options.time_limit_s = limits_.proof_time_s;
  options.memory_limit_bytes = limits_.proof_memory_bytes;
  options.samples = std::max<std::size_t>(100'000, live.plan.grid.size());
  Verification made = verify_plan(live.plan, "the moved goal's plan", {}, options);
  auto proof = std::make_shared<const ShortProof>(
      ShortProof{std::move(made.certificate), made.outcome.volume, made.outcome.stopped_by});
  live.set_proof(proof);
  return proof;
}

}  // namespace fairway
