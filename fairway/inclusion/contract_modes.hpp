// What is proved of a plan with all its modes, under a vehicle contract (docs/modes.md).
//
// Properties that always hold, of each further mode: those of contract_verdicts.hpp; its leaves are
// proved to reach, or undecided; its groups' next modes are earlier ones.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/inclusion/contract_hand_over.hpp"
#include "fairway/inclusion/contract_lookup.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/inclusion_prover.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/verify/flow.hpp"

namespace fairway {

/// One mode, wherever what is proved of it lies.
struct ContractMode {
  const Parts& parts;  ///< with its commands
  ContractVerdictsView verdicts;
};

struct ContractModeAnswer {
  ContractAnswer answer;  ///< by the first mode that is proved to reach; else that of mode 0
  int mode = 0;
};

/// `place`: in parts; no side is held. `modes`: all of them, mode 0 first.
[[nodiscard]] ContractModeAnswer answer_of_modes(std::span<const ContractMode> modes,
                                                 double speed_least_mps, Vec2 place,
                                                 double heading_rad);

/// A further mode with its parts and what is proved of it.
struct ProvedContractMode {
  Parts parts;
  ContractVerdicts verdicts;
};
using ProvedContractModes = std::vector<std::unique_ptr<const ProvedContractMode>>;

struct ContractModesProof {
  ProvedContractModes further;
  bool stopped_by_limit = false;
};

/// Further modes one after another, as files have them: of `sections` sections a mode, section s of
/// mode k is number sections (k - 1) + s. Groups are numbered on, behind one group 0 for all.
[[nodiscard]] ContractVerdicts joined(const ProvedContractModes& modes);

/// Proves further modes, [mode - 1][iy][ix], one after another. `flow`, `first`: of mode 0, which
/// is proved, and outlives the call. `contract`: over ground (over_ground); `error`: that of the
/// vehicle's estimate. Where a limit stops it, modes that were not begun are undecided everywhere.
[[nodiscard]] ContractModesProof prove_contract_modes(
    const Flow& flow, std::span<const float* const> further_rad, const VehicleContract& contract,
    int per_cell, const EstimateError& error, const ContractMode& first,
    const InclusionLimits& limits, const std::function<void(int mode)>& progress);

}  // namespace fairway
