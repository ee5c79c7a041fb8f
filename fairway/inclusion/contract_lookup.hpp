// What is proved of single states under a contract.
#pragma once

#include "fairway/base/grid.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/inclusion/behaviour_flight.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/convex_set.hpp"
#include "fairway/inclusion/heading_arc.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

struct ContractAnswer {
  Verdict verdict = Verdict::undecided;
  double worst_time_s = 0.0;  ///< no behaviour takes longer; +inf when trapped or undecided
  /// Bit v: some behaviour may come to Verdict v. When undecided, looking ends as soon as it is:
  /// then there may be others; and a section it may cross that is undecided, or none.
  std::uint8_t possible = 0;
  std::size_t undecided_section = no_section;
  double undecided_place = 0.0;  ///< along it, 0 to 1

  static constexpr std::size_t no_section = ~std::size_t{0};
};

/// `place`: in parts; no side is held. What holds for every behaviour within the contract.
[[nodiscard]] ContractAnswer contract_answer(const Parts& parts,
                                             const ContractVerdictsView& verdicts,
                                             double speed_least_mps, Vec2 place, double heading_rad,
                                             const BehaviourOptions& options = {});

/// The same for all states at a place of `set`, which lies in an ordinary part, and with a heading
/// of `headings`.
[[nodiscard]] ContractAnswer contract_answer(const Parts& parts,
                                             const ContractVerdictsView& verdicts,
                                             double speed_least_mps, PartPlace part,
                                             const ConvexSet& set, const HeadingArc& headings);

/// The same for a state in metres, wherever it is: what lies a million cells off has left.
[[nodiscard]] ContractAnswer contract_answer(const Grid& grid, const Parts& parts,
                                             const ContractVerdictsView& verdicts,
                                             double speed_least_mps, Vec2 position_m,
                                             double heading_rad);

}  // namespace fairway
