// Leaves that are handed over to an earlier mode (docs/trust.md, "Modes under a contract"): from
// where and with which headings the earlier mode's behaviours may begin.
#pragma once

#include <cstddef>
#include <functional>

#include "check/contract_certificate.hpp"
#include "check/shape.hpp"

namespace fairway_check {

/// States in an ordinary part of `mode`: places from its corner, headings in [least, most].
struct StatesOfPart {
  std::size_t part;
  Shape at;
  double least;
  double most;
};

/// Calls visit(states) with all states within twice the error of the vehicle's estimate of a leaf's
/// states, but for those where a flight has ended; until it says false. False, too, if it is not
/// known which states these are.
bool for_states_around(const ContractCertificate& c, std::size_t section, std::size_t leaf,
                       const std::function<bool(const StatesOfPart&)>& visit);

}  // namespace fairway_check
