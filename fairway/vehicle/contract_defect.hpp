// What makes numbers a contract that a vehicle can keep, and a proof can use.
#pragma once

#include <optional>
#include <string>

#include "fairway/vehicle/contract.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

struct ContractDefect {
  std::string key;   ///< "turn_radius_m"
  std::string what;  ///< "is [22, 18] m, expected the smaller number first: [18, 22]"
};

/// The first defect of `contract` for the plan's vehicle, in one sentence with its cure; none when
/// every number is finite and in its range, both ranges are in order and hold the vehicle's own
/// radius and speed, and the wind is slower than the vehicle.
[[nodiscard]] std::optional<ContractDefect> contract_defect(const VehicleContract& contract,
                                                            const Vehicle& nominal);

/// Throws InputError{where.KEY, ...} for a contract with a defect.
void require_contract(const VehicleContract& contract, const Vehicle& nominal,
                      const std::string& where);

}  // namespace fairway
