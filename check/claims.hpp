// Compares the volumes a certificate claims with sampled states. No verdict depends on this.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "check/flight.hpp"

namespace fairway_check {

/// What the leaves say about a state.
struct Told {
  Verdict verdict;
  double worst_s;        ///< no state takes longer
  std::size_t mode = 0;  ///< the first in which it reaches
};

/// The cells that shares are of.
struct ClaimedCells {
  const Loop& loop;
  const std::vector<std::int8_t>& region;
  const std::vector<std::uint8_t>& holding;
  std::size_t modes = 1;
};

/// Of the state at (x, y), in cells from the centre of an ordinary cell. Called by several threads
/// at once.
using TellState = std::function<Told(std::size_t cell, double x, double y, double heading_rad)>;

/// "" when no claimed share of volume is farther than five standard errors (of both samples) from
/// the one measured with `samples` states, those by mode included, and no more states reach later
/// than chance allows. The findings go into `report`. Throws Defect 1, or
/// nlohmann::json::exception, for impossible claims.
/// `may_prove_more`: claims of less than is measured here are no defect.
std::string defect_of_claims(const nlohmann::json& record, const ClaimedCells& of,
                             std::size_t samples, bool may_prove_more, const TellState& tell,
                             nlohmann::ordered_json& report);

}  // namespace fairway_check
