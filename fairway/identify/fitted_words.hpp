// A fitted contract in words: which log and which moment stop each number from being smaller.
#pragma once

#include <span>

#include "fairway/identify/explained_contract.hpp"
#include "fairway/identify/fitted_contract.hpp"
#include "fairway/identify/flight_log.hpp"

namespace fairway {

struct FitMargins {
  /// Every error is this share larger, every range this share wider; besides, the heading error by
  /// this share of a degree, and the radii by this share of 5 %.
  double share = 0.0;
  double position_error_m = 0.0;  ///< of the places in the logs, added to the command's
};

/// Widened by the margins and rounded outwards to three digits.
[[nodiscard]] ExplainedContract explained(const FittedContract& fit,
                                          std::span<const FlightLog> logs,
                                          const FitMargins& margins);

}  // namespace fairway
