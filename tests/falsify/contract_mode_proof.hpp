// Proofs of plans with modes under a contract, as the attack needs them.
#pragma once

#include <cstdint>

#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/inclusion/contract_hand_over.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway {

struct ModeProofEffort {
  int per_cell = 1;
  int last_level = 3;
  double time_limit_s = 1e9;  ///< of mode 0, and of all further modes together
};

/// `error`: for which estimates it hands over; EstimateError::of(contract), unless a proof is to be
/// wrong.
[[nodiscard]] ContractCertificate prove_with_modes(const Plan& plan,
                                                   const VehicleContract& contract,
                                                   const EstimateError& error,
                                                   const ModeProofEffort& effort);

struct ContractModeTrial {
  Plan plan;
  VehicleContract contract;
};

/// A goal among some obstacles, fields that go on in one direction each, and errors of up to a
/// third of a cell and 0.04 rad.
[[nodiscard]] ContractModeTrial contract_mode_trial(std::uint64_t seed);

}  // namespace fairway
