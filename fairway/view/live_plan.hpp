// Plans of the live page: the folder's own, and those for goals moved on the page.
//
// Properties that always hold:
//   1. A moved goal's plan is replan() of the folder's plan (run/replan.hpp): a pure function of
//      the folder and the goal. Verdicts are its own or none, never those of the folder's plan.
//   2. One plan, or one proof, is made at a time; a request meanwhile waits `patience`, then gets
//      NotNow. No more than `kept` plans stay in memory, and none of more than `most_cells` cells
//      is made.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "fairway/certificate/certificate.hpp"
#include "fairway/field/field.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/runtime.hpp"
#include "fairway/verify/certify.hpp"

namespace fairway {

struct ReplanLimits {
  std::size_t most_cells = 4'000'000;
  std::size_t kept = 3;
  std::chrono::milliseconds patience{15'000};
  double proof_time_s = 5.0;  ///< of a short proof
  std::size_t proof_memory_bytes = 1'000'000'000;
};

/// Another plan or proof is being made: try again.
class NotNow : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a short proof found.
struct ShortProof {
  Certificate certificate;
  VolumeFractions volume;
  StoppedBy stopped_by = StoppedBy::undecided_max;

  runtime::Certificate asked() const {
    runtime::Certificate all;
    all.look_into(certificate.view());
    return all;
  }
};

/// A plan with its flights. Immutable, except that a proof may be added.
class LivePlan {
 public:
  explicit LivePlan(Plan made) : plan(std::move(made)), flights(plan) {}
  LivePlan(const LivePlan&) = delete;
  LivePlan& operator=(const LivePlan&) = delete;
  ~LivePlan() = default;

  std::shared_ptr<const ShortProof> proof() const {
    const std::scoped_lock lock(mutex_);
    return proof_;
  }
  void set_proof(std::shared_ptr<const ShortProof> proof) const {
    const std::scoped_lock lock(mutex_);
    proof_ = std::move(proof);
  }

  const Plan plan;
  const FlightEngine flights;

 private:
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const ShortProof> proof_;
};

class MovedGoals {
 public:
  /// `plan` must outlive this.
  explicit MovedGoals(const Plan& plan, const ReplanLimits& limits = {})
      : plan_(plan), limits_(limits) {}

  /// The reason why goals cannot be moved on this plan; empty: they can.
  [[nodiscard]] std::string refusal() const;

  /// The plan to a goal on the grid, made or remembered. Throws BadQuestion where goals cannot be
  /// moved, and NotNow.
  [[nodiscard]] std::variant<std::shared_ptr<const LivePlan>, MissionRefusal> plan_to(
      Vec2 goal_m) const;

  /// Its short proof, made or remembered.
  [[nodiscard]] std::shared_ptr<const ShortProof> proof_of(const LivePlan& plan) const;

 private:
  using Turn = std::unique_lock<std::timed_mutex>;
  Turn turn() const;
  std::shared_ptr<const LivePlan> remembered(const Mission& mission) const;

  const Plan& plan_;
  const ReplanLimits limits_;
  mutable std::timed_mutex making_;
  mutable std::mutex mutex_;
  mutable std::deque<std::shared_ptr<const LivePlan>> kept_;  ///< the latest first
};

}  // namespace fairway
