// The tightest vehicle contract that flight logs keep.
//
// Of all contracts that the logs keep at a tracking distance, the search looks for one of small
//   cost = rho / r + (r2 - r1) / r + 4 eps + side / 4,
// r the radius that was flown at full bank: an error of place or a spread of radii by one radius is
// counted as much as 14 degrees of heading error, which is about what each costs in states proved.
// It begins with a wide contract, tightens all its numbers together as far as the logs allow, and
// then one after the other, each time the one that lowers the cost most. Every step is judged by
// the search for a motion (nearest_motion.hpp), so the result is kept; another contract may be as
// tight.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "fairway/identify/commands_in_force.hpp"
#include "fairway/identify/flown_track.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway {

/// What was tightened.
enum class ContractPart : std::uint8_t {
  command_error,
  heading_error,
  least_radius,
  most_radius,
  side
};
inline constexpr std::size_t contract_parts = 5;

/// The log and the sample that stop a number from being tightened further.
struct Decider {
  std::size_t log = 0;
  std::size_t sample = 0;
};

/// None: the number reached its ideal.
using Deciders = std::array<std::optional<Decider>, contract_parts>;

struct FittedContract {
  VehicleContract contract;
  double turn_radius_m = 0.0;  ///< flown at full bank: the median over the logs
  double tracking_m = 0.0;
  Deciders deciders;
};

struct FitOptions {
  double tracking_m = 0.0;     ///< above 0
  double turn_radius_m = 0.0;  ///< flown at full bank
  SideRule sides = SideRule::each_command;
};

/// Nothing when the logs keep no contract of the widest kind tried: then `broken` is set.
[[nodiscard]] std::optional<FittedContract> fitted_contract(const std::vector<FlownTrack>& tracks,
                                                            const FitOptions& options,
                                                            Decider& broken);

/// The cost of a contract, see above.
[[nodiscard]] double contract_cost(const VehicleContract& contract, double turn_radius_m);

}  // namespace fairway
