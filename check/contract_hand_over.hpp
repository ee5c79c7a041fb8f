// Leaves that are handed over to an earlier mode (docs/trust.md, "Modes under a contract"): from
// where and with which headings the earlier mode's behaviours may begin.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

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

/// What was found about boxes of states of one mode: a whole part, with what is so near that it may
/// be taken to be in it, and a sixty-fourth of a turn. Neighbouring leaves ask about the same ones.
/// Several threads may.
class KnownBoxes {
 public:
  static constexpr std::uint64_t per_turn = 64;

  explicit KnownBoxes(std::size_t parts);

  /// Seconds within which all states of these boxes reach, infinite when they do not, or when it
  /// takes more than these boxes to hold the states. `find`: the same of single ones.
  double seconds(const StatesOfPart& states,
                 const std::function<double(const StatesOfPart&)>& find) const;

 private:
  int size_log2_;
  std::unique_ptr<std::atomic<std::uint64_t>[]> known_;  ///< a box's key and seconds, or 0
};

}  // namespace fairway_check
