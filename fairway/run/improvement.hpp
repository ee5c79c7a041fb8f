// A plan with better commands: proposed on a model (improve/), kept only when proofs confirm it.
//
// Properties that always hold:
//   1. A plan that is kept proves more of all states than the one before could, had its proof gone
//      on: what that left undecided counts against it. Under the plan's contract, if it has one, it
//      proves no less.
//   2. It differs in nothing but the commands of cells that have one, and in its record.
//   3. The result does not depend on the number of threads, unless a time limit ends some of the
//      work.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fairway/improve/improve_commands.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

struct ImprovementOptions {
  double undecided_max = 0.01;  ///< of the proofs
  /// Of the search for better commands, 0: none. Each proof of improved commands is given five
  /// times as long as the first one took, and at least 20 s.
  double time_limit_s = 0.0;
  int sweeps = ImproveOptions{}.sweeps;
  /// No command may differ from its neighbours by more than it does, unless it is by less than
  /// this. None: as it proves best.
  std::optional<double> most_bend_rad;
};

/// Shares of all states that are proved to do what the mission asks.
struct SharesKept {
  double exact = 0.0;
  double exact_at_most = 0.0;  ///< with what the proof left undecided before its end
  std::optional<double> under_contract;
};

struct Improvement {
  Plan plan;                         ///< the improved one, or the one that was given
  std::vector<std::size_t> changed;  ///< cells whose commands differ
  SharesKept before;
  SharesKept after;          ///< of `plan`
  std::size_t attempts = 0;  ///< improved plans that were proved
};

/// Throws InputError{where, ...} when the plan cannot be verified, or is too large.
[[nodiscard]] Improvement improved(const Plan& plan, const std::string& where,
                                   const ImprovementOptions& options, StageClock& clock);

/// "4.1 %" of "cells with a command" "got another heading", and what it gains.
[[nodiscard]] std::vector<Finding> findings(const Plan& before, const Improvement& made);

/// x_m,y_m,before_rad,after_rad: a line for each changed cell, at its centre.
[[nodiscard]] std::string changes_csv(const Plan& before, const Improvement& made);

}  // namespace fairway
