// What the live page asks: the verdict of a state, its flight, and how to steer to a pose; answered
// from a plan and a certificate in memory.
//
// Properties that always hold: an answer is a pure function of the folder's plan and certificate
// and of the question; several threads may ask at once. Cost: a query takes about a microsecond, a
// flight some 30 ns a cell, steering below a millisecond.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "fairway/base/loaded_file.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/runtime.hpp"

namespace fairway {

class LiveEngine {
 public:
  /// Reads plan.safetensors and, when it is there, certificate.safetensors of a run's folder.
  /// Throws InputError{file, ...} for what is not whole, or a certificate of another plan.
  explicit LiveEngine(const std::filesystem::path& folder);

  const Grid& grid() const { return plan_.grid; }

  /// Which plan this is, and whether there are verdicts.
  [[nodiscard]] nlohmann::json info() const;

  /// The verdict of a state on the grid with its time bound, and its exact flight.
  [[nodiscard]] nlohmann::json state(const State& start) const;

  /// From a state to a pose, both on the grid: the shortest path, and when that touches an obstacle
  /// the shortest clear approach.
  [[nodiscard]] nlohmann::json steer(const State& from, const State& to) const;

 private:
  Plan plan_;
  FlightEngine flights_;
  std::unique_ptr<LoadedFile> file_;  ///< of the certificate
  runtime::Certificate certificate_;
};

}  // namespace fairway
