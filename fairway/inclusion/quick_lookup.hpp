// Verdicts of single states within a microsecond, where contract_answer takes ten or more: for
// whoever asks millions.
//
// The same flight as that of behaviour_flight.hpp, in a cheaper geometry: sets are octagons
// (octagon.hpp), headings integers, and where behaviours do nothing but turn on, steps are long.
// Where that does not give one verdict, a few single behaviours are tried out; where they do not
// contradict each other, either, it is flown again in short steps, which tell more than those of
// contract_answer. Only where sets are very large, or a state lies within the slack of a
// border between parts, contract_answer is asked itself.
//
// Properties that always hold:
//   1. An answer other than undecided holds for every behaviour within the contract that starts in
//      the state, without a side held; worst_time_s, too.
//   2. Answers depend on the state alone. They may be undecided where that of contract_answer is
//      not, and the other way round, which is more frequent.
//   3. Nothing is allocated after the start but what contract_answer takes and gives back.
// Safe to ask from several threads at once.
#pragma once

#include "fairway/base/grid.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/inclusion/contract_lookup.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/convex_set.hpp"
#include "fairway/inclusion/heading_arc.hpp"
#include "fairway/inclusion/lookup_table.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/inclusion/quick_flight.hpp"

namespace fairway {

class QuickLookup {
 public:
  /// Keeps a reference to `parts`, and what `verdicts` points to. Takes 48 bytes a part.
  QuickLookup(const Parts& parts, const ContractVerdictsView& verdicts, double speed_least_mps);

  /// `place`: in parts; no side is held.
  ContractAnswer answer(Vec2 place, double heading_rad) const;
  /// The same for a state in metres, wherever it is.
  ContractAnswer answer(const Grid& grid, Vec2 position_m, double heading_rad) const;

  enum class Reaches { yes, unknown, no };
  struct SetReach {
    Reaches reaches = Reaches::unknown;
    double time_s = 0.0;  ///< bound; of `yes`
  };
  /// Whether every behaviour reaches that starts at a place of `set`, in an ordinary part or on its
  /// border, and with a heading of `headings`, and holds no side. `yes` is proved, by long steps:
  /// what flies in short ones will find the same. `no`: not even short steps would prove it.
  SetReach reach(PartPlace part, const ConvexSet& set, const HeadingArc& headings) const;

 private:
  const Parts& parts_;
  ContractVerdictsView verdicts_;
  double speed_least_mps_;
  LookupTable table_;
  QuickFlightOptions coarse_;
  QuickFlightOptions fine_;
};

}  // namespace fairway
