// The further modes of a plan (docs/modes.md): of fields made by rule, those that earn states.
//
// Candidates go on in one of sixteen directions and bend along walls, or lead to places from which
// mode 0 is proved whichever way the vehicle faces. Sampled states that mode 0 is
// not proved to bring fly each of them, and are handed over where mode 0 is proved from there. The
// field that so saves most of them becomes the next mode, until none saves enough of the rest.
//
// Properties that always hold: mode 0 stays as it is; the choice depends on the plan and the
// options alone, not on threads or time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/plan/plan.hpp"

namespace fairway {

struct ModeOptions {
  std::size_t most = 16;      ///< further modes
  double least_gain = 0.001;  ///< of all states, by each
  std::size_t states = 8000;  ///< sampled
};

struct ChosenModes {
  std::vector<float> heading_rad;  ///< [mode - 1][iy][ix]
  std::vector<ModeRecord> records;
  std::vector<double> gain;  ///< by each: share of all states that were sampled
  double alone = 0.0;        ///< share that mode 0 brings
};

/// Whether a plan that was not asked to have modes gets these: two per cent of all states or more.
[[nodiscard]] bool are_worth_it(const ChosenModes& chosen);

/// Throws InputError{where, ...} when the plan cannot be verified.
[[nodiscard]] ChosenModes choose_modes(const Plan& plan, const std::string& where,
                                       const ModeOptions& options = {});

}  // namespace fairway
