// Answers the live page's questions (the verdict of a state, its flight, how to steer to a pose)
// from a plan and its certificates in memory.
//
// Properties that always hold: an answer is a pure function of the folder's plan and certificates
// and of the question, except for proof(), which a time limit may end; several threads may ask at
// once. Cost: a query takes about a microsecond (under a contract more: live_contract.hpp), a
// flight some 30 ns a cell, steering below a millisecond, a plan 0.2 microseconds a cell, a short
// proof seconds (live_plan.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "fairway/base/loaded_file.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/runtime.hpp"
#include "fairway/view/live_contract.hpp"
#include "fairway/view/live_plan.hpp"

namespace fairway {

class LiveEngine {
 public:
  /// Reads plan.safetensors and, when they are there, certificate.safetensors and
  /// contract.certificate.safetensors of a run's folder; `contract_certificate`, when given,
  /// instead of the latter. Throws InputError{file, ...} for an incomplete file, or a certificate
  /// of another plan or contract.
  explicit LiveEngine(const std::filesystem::path& folder, const ReplanLimits& limits = {},
                      const std::filesystem::path& contract_certificate = {});

  const Grid& grid() const { return plan_.grid; }

  /// Which plan this is, and which verdicts there are.
  [[nodiscard]] nlohmann::json info() const;

  /// The verdict of a state with its time bound, and its exact flight; a state outside the grid has
  /// left, as in a query of the certificate. `contract`: null, or what is proved under the contract
  /// (LiveContract::state). `goal_m`: under the plan to a goal moved there; the verdict is null
  /// until proof() has been asked for, and `contract` always. Throws BadQuestion and NotNow.
  [[nodiscard]] nlohmann::json state(const State& start, std::optional<Vec2> goal_m = {}) const;

  /// The plan to a moved goal as the page's arrays (report/page_arrays.hpp), or the reason why
  /// there is none. Throws BadQuestion and NotNow.
  [[nodiscard]] nlohmann::json replan(Vec2 goal_m) const;

  /// A short proof of that plan: shares, and verdicts for the page's map. Throws the same.
  [[nodiscard]] nlohmann::json proof(Vec2 goal_m) const;

  /// From a state to a pose, both on the grid: the shortest path, and when that touches an obstacle
  /// the shortest clear approach.
  [[nodiscard]] nlohmann::json steer(const State& from, const State& to) const;

 private:
  void read_exact(const std::filesystem::path& file);

  Plan plan_;
  FlightEngine flights_;
  MovedGoals moved_;
  std::unique_ptr<LoadedFile> file_;  ///< of the certificate
  runtime::Certificate certificate_;
  std::unique_ptr<const LiveContract> contract_;
};

}  // namespace fairway
